//! The list of methods, used by `--method`, the survey and the charts.

use crate::rank::exact::modular;
use crate::rank::exact::rational;
use crate::rank::method::MobilityMethod;
use crate::rank::method::auto;
use crate::rank::method::formulas;
use crate::rank::method::generic;
use crate::rank::numeric::Elimination;

/// Every method, the cheapest kind first.
pub const ALL: [&dyn MobilityMethod; 13] = [
    &formulas::Spatial,
    &formulas::Planar,
    &formulas::Loops,
    &generic::Generic,
    &Elimination::Lu32,
    &Elimination::Lu,
    &Elimination::Qr32,
    &Elimination::Qr,
    &Elimination::Svd,
    &modular::Modular,
    &rational::Rational,
    &auto::Exact,
    &auto::Auto,
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
pub fn by_name(name: &str) -> Option<&'static dyn MobilityMethod> {
    ALL.into_iter().find(|m| m.about().name == name)
}
