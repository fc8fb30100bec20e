//! Common interface of all mobility methods; [`crate::rank::method::registry`] lists them.

pub mod auto;
mod floating_point;
pub(crate) mod formulas;
pub mod generic;
pub mod registry;

use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::numeric::Elimination;
use thiserror::Error;

/// The quantity that an answer describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A count from the structure alone.
    Count,
    /// f - rank J at the pose of the file.
    Instantaneous,
    /// The finite mobility.
    Finite,
}

/// Certainty of an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Certainty {
    /// Counted, without any statement about the geometry.
    Counted,
    /// Follows from exact arithmetic, up to primes that divide a minor (below 10^-17 for one prime near 2^61).
    Exact,
    /// Proven: nonzero pivots and a kernel in characteristic 0, confirmed by [`crate::verify`], in addition to the
    /// ranks over two prime fields.
    Proven {
        /// The primes.
        primes: [u64; 2],
    },
    /// Rank over two prime fields, on exact geometry. A rank modulo a prime never exceeds the true rank, and is smaller
    /// only if the prime divides a nonzero minor. Two primes near 2^61 agree on a wrong rank with probability below
    /// 10^-30.
    Modular {
        /// The primes.
        primes: [u64; 2],
    },
    /// Floating point.
    Numeric {
        /// Source of the rank, such as `f64 singular values`.
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
    /// Coordinates are rounded, and it is undecided whether the coordinates as written or nearby ones are intended.
    Undecided {
        /// The rank with every digit taken exactly as written, which is the maximum.
        as_written: usize,
        /// The rank that may be intended.
        near: usize,
        /// The singular value above the gap between the two, relative to the largest.
        kept: f64,
        /// The singular value below the gap.
        dropped: f64,
    },
}

impl Certainty {
    /// Describes the certainty in one line for display.
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Certainty::Counted => "counted, independent of the geometry".to_owned(),
            Certainty::Exact => "exact arithmetic".to_owned(),
            Certainty::Proven { .. } => {
                "exact geometry; rank proven by a checked certificate; agrees modulo two primes"
                    .to_owned()
            }
            Certainty::Modular { .. } => "exact geometry; ranks modulo two primes agree".to_owned(),
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
                "undecided: rank {as_written} as written, {near} if the last digits are rounding \
                errors (singular values {kept:.1e} above the gap, {dropped:.1e} below it)"
            ),
        }
    }

    /// Returns the primes used for modular ranks.
    #[must_use]
    pub fn primes(&self) -> Option<[u64; 2]> {
        match *self {
            Certainty::Proven { primes } | Certainty::Modular { primes } => Some(primes),
            _ => None,
        }
    }

    /// Returns one word for programs.
    #[must_use]
    pub fn as_word(&self) -> &'static str {
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
    /// Quantity that the mobility describes.
    pub quantity: Quantity,
    /// Certainty of the mobility.
    pub certainty: Certainty,
}

impl Answer {
    /// Creates a count from the structure.
    pub(in crate::rank) fn from_count(mobility: i64, certainty: Certainty) -> Answer {
        Answer {
            mobility,
            quantity: Quantity::Count,
            certainty,
        }
    }

    /// Creates the answer W = freedoms - rank at the pose of the file.
    pub(in crate::rank) fn at_pose(freedoms: usize, rank: usize, certainty: Certainty) -> Answer {
        Answer {
            mobility: to_i64(freedoms) - to_i64(rank),
            quantity: Quantity::Instantaneous,
            certainty,
        }
    }
}

pub(crate) fn to_i64(x: usize) -> i64 {
    i64::try_from(x).unwrap_or(i64::MAX)
}

/// Reason why a method has no answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoAnswer {
    /// The method does not support such a mechanism.
    #[error("does not apply: {0}")]
    DoesNotApply(&'static str),
    /// The geometry has no value in the method's number system.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The arithmetic failed.
    #[error("{0}")]
    Failed(String),
}

/// Kind of rank that a full analysis, with shares and self-stresses, takes from a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RankOfJ {
    /// Exact or within a tolerance, depending on the coordinates.
    Chosen,
    /// Over prime fields.
    Exact,
    /// In floating point.
    Numeric(Elimination),
    /// No rank: the method only gives a mobility.
    NotFound,
}

/// A method that computes the mobility of a mechanism.
#[derive(Debug, Clone, Copy)]
pub struct MobilityMethod {
    /// One word, as on the command line.
    pub name: &'static str,
    /// Short description.
    pub title: &'static str,
    /// Description in one sentence, for the help.
    pub help: &'static str,
    /// Condition under which its answer is right.
    pub guarantee: &'static str,
    /// Its cost for n links, p joints, k contours, f freedoms.
    pub complexity: &'static str,
    /// Source in the literature.
    pub source: &'static str,
    /// Kind of rank that a full analysis can use.
    pub rank: RankOfJ,
    pub(in crate::rank) answer: fn(&Mechanism, StateId) -> Result<Answer, NoAnswer>,
}

impl MobilityMethod {
    /// Returns one word, as on the command line.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the answer for a state.
    ///
    /// # Errors
    /// Returns an error if the method does not apply or fails.
    pub fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        (self.answer)(mechanism, state)
    }
}
