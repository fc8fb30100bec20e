//! The list of methods: what `--method`, the survey and the charts offer.

use super::method::MobilityMethod;
use super::numeric::Elimination;
use super::{auto, counting, finite_exact, generic, loops, modular, rational};

/// Every method, the cheapest kind first.
pub const ALL: [&dyn MobilityMethod; 13] = [
    &counting::Spatial,
    &counting::Planar,
    &loops::Loops,
    &generic::Generic,
    &Elimination::Lu32,
    &Elimination::Lu,
    &Elimination::Qr32,
    &Elimination::Qr,
    &Elimination::Svd,
    &modular::Modular,
    &rational::Rational,
    &finite_exact::Exact,
    &auto::Auto,
];

/// The method of a name.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static dyn MobilityMethod> {
    ALL.into_iter().find(|m| m.about().name == name)
}
