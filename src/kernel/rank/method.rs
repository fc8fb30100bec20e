//! What every way of saying how far a mechanism moves has in common; [`crate::rank::method::registry`] lists them.

pub mod auto;
pub(crate) mod finite_exact;
pub(crate) mod formulas;
pub mod generic;
pub mod registry;
pub(crate) mod sum_of_loops;

use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, StateId};
use std::fmt::Debug;
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Certainty {
    /// Counted; nothing is said about the geometry.
    Counted,
    /// Follows from exact arithmetic, up to primes that divide a minor (below 10^-17 for one prime near 2^61).
    Exact,
    /// Proven: pivots that do not vanish and a kernel in characteristic 0, confirmed by [`crate::verify`], beside the
    /// ranks over two prime fields.
    Proven {
        /// The primes.
        primes: [u64; 2],
    },
    /// Rank over two prime fields, on exact geometry. A rank modulo a prime never exceeds the true rank, and falls short
    /// only where the prime divides a nonzero minor; two primes near 2^61 agree on a wrong rank with probability
    /// below 10^-30.
    Modular {
        /// The primes.
        primes: [u64; 2],
    },
    /// Floating point.
    Numeric {
        /// What the rank is read off, such as `f64 singular values`.
        values: &'static str,
        /// Values below this fraction of the largest count as zero.
        tolerance: f64,
        /// The smallest kept value, relative to the largest.
        kept: f64,
        /// The largest dropped value, relative to the largest.
        dropped: f64,
    },
    /// Followed by Newton's method.
    Traced,
    /// Coordinates are rounded, and whether as written or as something near was meant is not decided.
    Undecided {
        /// The rank with every digit at its word, the most it can be.
        as_written: usize,
        /// The rank that may be meant.
        near: usize,
        /// The singular value above the gap that tells them apart, relative to the largest.
        kept: f64,
        /// The one below it.
        dropped: f64,
    },
}

impl Certainty {
    /// One line for people.
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Certainty::Counted => "counted, whatever the geometry".to_owned(),
            Certainty::Exact => "exact arithmetic".to_owned(),
            Certainty::Proven { .. } => {
                "exact geometry; rank proven by a checked certificate (--certificate), and the same modulo two primes"
                    .to_owned()
            }
            Certainty::Modular { .. } => {
                "exact geometry; ranks modulo two primes agree".to_owned()
            }
            Certainty::Numeric {
                values,
                tolerance,
                kept,
                dropped,
            } => format!(
                "{values}, tolerance {tolerance:.0e}: smallest kept {kept:.1e}, largest dropped {dropped:.1e}"
            ),
            Certainty::Traced => "followed numerically".to_owned(),
            Certainty::Undecided {
                as_written,
                near,
                kept,
                dropped,
            } => format!(
                "undecided: rank {as_written} as written, {near} if digits are left over from rounding (singular values \
                 {kept:.1e} above the gap, {dropped:.1e} below it)"
            ),
        }
    }

    /// The primes that ranks were found modulo.
    #[must_use]
    pub fn primes(&self) -> Option<[u64; 2]> {
        match *self {
            Certainty::Proven { primes } | Certainty::Modular { primes } => Some(primes),
            _ => None,
        }
    }

    /// One word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Certainty::Counted => "counted",
            Certainty::Exact => "exact",
            Certainty::Proven { .. } => "proven",
            Certainty::Modular { .. } => "modular",
            Certainty::Numeric { .. } => "numeric",
            Certainty::Traced => "traced",
            Certainty::Undecided { .. } => "undecided",
        }
    }
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

/// What a whole analysis, with shares and self-stresses, takes from a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RankOfJ {
    /// Exact or to within a tolerance, as suits the coordinates.
    Chosen,
    /// Over prime fields.
    Exact,
    /// In floating point.
    Numeric,
    /// Nothing: the method gives a mobility alone.
    NotFound,
}

/// What is said of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct About {
    /// One word, as on the command line.
    pub name: &'static str,
    /// What it does, in a few words.
    pub title: &'static str,
    /// What it does, in a sentence of the help.
    pub help: &'static str,
    /// When its answer is right.
    pub guarantee: &'static str,
    /// Its cost for n links, p joints, k contours, f freedoms.
    pub complexity: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Whether a whole analysis can rest on it.
    pub rank: RankOfJ,
}

/// A way to the mobility of a mechanism.
pub trait MobilityMethod: Debug + Sync {
    /// What is said of it.
    fn about(&self) -> &'static About;
    /// One word, as on the command line.
    fn name(&self) -> &'static str {
        self.about().name
    }
    /// The answer for a state.
    ///
    /// # Errors
    /// Where the method does not apply or fails.
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer>;
}
