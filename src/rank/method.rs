//! The methods behind one trait: every way of saying how far a mechanism moves, with what each knows about its answer.

use super::{auto, counting, finite, generic, loops, lu, modular, numeric, qr, rational};
use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, StateId};
use thiserror::Error;

/// What an answer is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A count from the structure alone.
    Count,
    /// f - rank J at the pose of the file.
    Instantaneous,
    /// The motion that is really there.
    Finite,
}

/// How sure an answer is.
#[derive(Debug, Clone, PartialEq)]
pub enum Certainty {
    /// Counted; nothing is said about the geometry.
    Counted,
    /// Follows from exact arithmetic, up to primes that divide a minor (below 10^-17 for one prime near 2^61).
    Exact,
    /// Floating point: what was kept and dropped, relative to the largest.
    Numeric {
        /// Relative tolerance.
        tolerance: f64,
        /// The smallest value kept.
        kept: f64,
        /// The largest value dropped.
        dropped: f64,
    },
    /// Followed by Newton's method.
    Traced,
}

/// An answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// W.
    pub mobility: i64,
    /// What it is a mobility of.
    pub quantity: Quantity,
    /// How sure it is.
    pub certainty: Certainty,
}

/// Why a method has no answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoAnswer {
    /// The method is not made for such a mechanism.
    #[error("does not apply: {0}")]
    DoesNotApply(&'static str),
    /// The geometry has no value in the method's number system.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The arithmetic failed.
    #[error("{0}")]
    Failed(String),
}

/// A way to the mobility of a mechanism.
pub trait MobilityMethod: Sync {
    /// One word, as on the command line.
    fn name(&self) -> &'static str;
    /// What it does, in a few words.
    fn title(&self) -> &'static str;
    /// When its answer is right.
    fn guarantee(&self) -> &'static str;
    /// Its cost for n links, p joints, k contours, f freedoms.
    fn complexity(&self) -> &'static str;
    /// Where it comes from.
    fn source(&self) -> &'static str;
    /// The answer for a state.
    ///
    /// # Errors
    /// Where the method does not apply or fails.
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer>;
}

/// Every method, the cheapest kind first.
pub const ALL: [&dyn MobilityMethod; 13] = [
    &counting::Spatial,
    &counting::Planar,
    &loops::Loops,
    &generic::Generic,
    &lu::Lu::<f32>::DEFAULT,
    &lu::Lu::<f64>::DEFAULT,
    &qr::Qr::<f32>::DEFAULT,
    &qr::Qr::<f64>::DEFAULT,
    &numeric::Svd::DEFAULT,
    &modular::Modular,
    &rational::Rational,
    &finite::Exact,
    &auto::Auto,
];

/// The method of a name.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static dyn MobilityMethod> {
    ALL.into_iter().find(|m| m.name() == name)
}
