//! Singular values of J, the gaps between them that distinguish numerical residue from zero, and bounds for the effect
//! of rounding on them.

use crate::closure::Closure;
use crate::geom::expr::Expr;
use crate::geom::vector::{length as norm, to_vector};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::rounded::Uncertainties;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::NumericError;
use crate::rank::numeric::scaling::{NumericRank, Scaling, scaled_matrix};
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
    let mut relative = singular_values(&scaled_matrix(closure))
        .ok_or_else(|| NoAnswer::Failed(NumericError::NoConvergence.to_string()))?;
    let largest = relative.first().copied().filter(|s| *s > 0.0);
    Ok(largest.map(|largest| {
        relative.iter_mut().for_each(|v| *v /= largest);
        Values { largest, relative }
    }))
}

impl Values {
    pub(in crate::rank) fn count_above(&self, tolerance: f64) -> usize {
        self.relative.iter().filter(|v| **v > tolerance).count()
    }

    /// Returns the rank with the gap it is based on.
    pub(in crate::rank) fn rank_at(&self, rank: usize) -> NumericRank {
        let value = |i: usize| self.relative.get(i).copied();
        NumericRank {
            rank,
            kept: rank.checked_sub(1).and_then(value).unwrap_or(1.0),
            dropped: value(rank).unwrap_or(0.0),
        }
    }

    /// Returns the ratio between the last value of a rank and the next one, with values below a floor raised to it.
    pub(in crate::rank) fn gap_at(&self, rank: usize, floor: f64) -> f64 {
        let found = self.rank_at(rank);
        found.kept.max(floor) / found.dropped.max(floor)
    }

    /// Returns the rank at a gap so wide, with values below it so small, that they are probably numerical residue of
    /// zero.
    pub(in crate::rank) fn left_over(&self, rank: usize) -> Option<usize> {
        (1..rank).find(|&r| self.gap_at(r, ROUND_OFF) >= GAP && self.rank_at(r).dropped < LEFT_OVER)
    }
}

/// Returns the maximum change of any singular value of the scaled J by coordinate errors of at most these half units.
///
/// By Weyl's inequality no singular value changes by more than the norm of the change of the matrix (Golub & Van Loan,
/// "Matrix Computations", 2013, 8.6.2). An error of its direction affects a turn directly, and also in its moment, at
/// an arm of at most the mechanism's size. The error of the point adds to this.
#[must_use]
pub(in crate::rank) fn rounding_bound(
    m: &Mechanism,
    closure: &Closure<f64>,
    half: &Uncertainties,
) -> f64 {
    let size = Scaling::of_closure(closure).length();
    let error = |freedom: Freedom, j: JointId| {
        let (joint, half) = (&m.joints[j], &half.frames[j.index()]);
        let of = &joint.joint_type;
        let angle = |h: [f64; 3], v: &[Expr; 3]| norm(h) / norm(to_vector(v));
        let axis = angle(half.axis, &joint.frame.axis);
        let length = norm(half.point) / size;
        let turns = of.freedoms().iter().filter(|f| f.is_turn()).count();
        // Second axes are computed from two vectors.
        let own = match freedom {
            Freedom::Rz | Freedom::Tz | Freedom::Screw => axis,
            Freedom::Rx | Freedom::Ry | Freedom::Tx | Freedom::Ty => {
                axis + angle(half.reference, &joint.frame.reference)
            }
        };
        match freedom {
            Freedom::Tx | Freedom::Ty | Freedom::Tz => own,
            // Turns about a point are the same for any direction of its axes.
            Freedom::Rx | Freedom::Ry | Freedom::Rz if turns == 3 => length,
            Freedom::Screw => 2.0 * own + 2.0 * length + half.pitch / size,
            _ => 2.0 * own + length,
        }
    };
    let squares = closure.columns.iter().map(|c| {
        let passing = closure.contours.iter();
        let passing = passing
            .filter(|k| k.direction_of(c.joint).is_some())
            .count();
        let times = passing as f64;
        times * error(c.freedom, c.joint).powi(2)
    });
    squares.sum::<f64>().sqrt()
}
