//! The list of methods, used by the command line, the survey and the charts.

use crate::rank::exact::{modular::MODULAR, rational::RATIONAL};
use crate::rank::method::MobilityMethod;
use crate::rank::method::auto::{AUTO, FINITE};
use crate::rank::method::floating_point::{LU, LU32, QR, QR32, SVD};
use crate::rank::method::formulas::{LOOPS, PLANAR, SPATIAL};
use crate::rank::method::generic::GENERIC;

/// Every method, the cheapest kind first.
pub const ALL: [&MobilityMethod; 13] = [
    &SPATIAL, &PLANAR, &LOOPS, &GENERIC, &LU32, &LU, &QR32, &QR, &SVD, &MODULAR, &RATIONAL,
    &FINITE, &AUTO,
];

/// Returns the method with a name.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::method::registry::by_name};
/// let bennett = ozols::built_in("bennett")?;
/// let by = |name| by_name(name).expect("there is one").answer(&bennett, StateId::FREE);
/// assert_eq!(by("modular")?.mobility, 1);
/// assert_eq!(by("svd")?.mobility, 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn by_name(name: &str) -> Option<&'static MobilityMethod> {
    ALL.into_iter().find(|m| m.name == name)
}
