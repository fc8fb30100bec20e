//! What rounding can do to singular values.

use crate::closure::matrix::Closure;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::Mechanism;
use crate::model::rounded::Units;
use crate::rank::numeric::scaling::Scaling;

/// The most by which rounding to half a unit can have changed any singular value of the scaled J.
///
/// By Weyl's inequality no singular value changes by more than the norm of the change of the matrix (Golub & Van Loan, "Matrix Computations", 2013,
/// 8.6.2). A unit vector whose components are rounded is off by √3/2 units at most; a turn feels that in its own direction
/// and, at an arm of at most the mechanism's size, in its moment, and feels the point's error beside.
#[must_use]
pub(in crate::rank) fn bound(m: &Mechanism, closure: &Closure<f64>, units: Units) -> f64 {
    let half = 3f64.sqrt() / 2.0;
    let direction = half * units.direction;
    let length = half * units.length / Scaling::of(closure).length();
    let error = |freedom: Freedom, of: &JointType| {
        let turns = of.freedoms().iter().filter(|f| f.turns()).count();
        // Second axes are made from two vectors.
        let own = match freedom {
            Freedom::Rz | Freedom::Tz | Freedom::Screw => direction,
            Freedom::Rx | Freedom::Ry | Freedom::Tx | Freedom::Ty => 2.0 * direction,
        };
        match freedom {
            Freedom::Tx | Freedom::Ty | Freedom::Tz => own,
            // All turns about a point are the same whichever way its axes point.
            Freedom::Rx | Freedom::Ry | Freedom::Rz if turns == 3 => length,
            Freedom::Screw => 2.0 * own + 2.0 * length,
            _ => 2.0 * own + length,
        }
    };
    let squares = closure.columns.iter().map(|c| {
        let passing = closure.contours.iter();
        let passing = passing.filter(|k| k.direction(c.joint).is_some()).count();
        #[allow(clippy::cast_precision_loss, reason = "contours are few")]
        let times = passing as f64;
        times * error(c.freedom, &m.joints[c.joint].joint_type).powi(2)
    });
    squares.sum::<f64>().sqrt()
}
