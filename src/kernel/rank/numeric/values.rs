//! Singular values of J, and the gaps between them that distinguish numerical residue from zero.

use crate::closure::Closure;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::NumericError;
use crate::rank::numeric::scaling::{NumericRank, scaled};
use ozols_dense::singular_values;

/// Singular values below this fraction of the largest are zero in double precision.
pub(in crate::rank) const ROUND_OFF: f64 = 1e-14;
/// Minimum ratio between neighbouring singular values that counts as a gap.
const GAP: f64 = 1e3;
/// A gap counts only if its lower end is below this fraction of the largest singular value.
const LEFT_OVER: f64 = 1e-4;

/// Singular values relative to the largest, in descending order.
pub(in crate::rank) struct Values {
    pub(in crate::rank) largest: f64,
    relative: Vec<f64>,
}

pub(in crate::rank) fn relative_values(closure: &Closure<f64>) -> Result<Option<Values>, NoAnswer> {
    let mut relative = singular_values(&scaled(closure))
        .ok_or_else(|| NoAnswer::Failed(NumericError::NoConvergence.to_string()))?;
    let largest = relative.first().copied().filter(|s| *s > 0.0);
    Ok(largest.map(|largest| {
        relative.iter_mut().for_each(|v| *v /= largest);
        Values { largest, relative }
    }))
}

impl Values {
    pub(in crate::rank) fn above(&self, tolerance: f64) -> usize {
        self.relative.iter().filter(|v| **v > tolerance).count()
    }

    /// Returns the rank with the gap it is based on.
    pub(in crate::rank) fn at(&self, rank: usize) -> NumericRank {
        let value = |i: usize| self.relative.get(i).copied();
        NumericRank {
            rank,
            kept: rank.checked_sub(1).and_then(value).unwrap_or(1.0),
            dropped: value(rank).unwrap_or(0.0),
        }
    }

    /// Returns the ratio between the last value of a rank and the next one, with values below a floor raised to it.
    pub(in crate::rank) fn gap(&self, rank: usize, floor: f64) -> f64 {
        let found = self.at(rank);
        found.kept.max(floor) / found.dropped.max(floor)
    }

    /// Returns the rank at a gap so wide, with values below it so small, that they are probably numerical residue of
    /// zero.
    pub(in crate::rank) fn left_over(&self, rank: usize) -> Option<usize> {
        (1..rank).find(|&r| self.gap(r, ROUND_OFF) >= GAP && self.at(r).dropped < LEFT_OVER)
    }
}
