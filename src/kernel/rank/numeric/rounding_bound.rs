//! Bounds for the effect of rounding on singular values.

use crate::closure::Closure;
use crate::geom::expr::Expr;
use crate::geom::vector::{length as norm, real};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::rounded::Uncertainties;
use crate::rank::numeric::scaling::Scaling;

/// Returns the maximum change of any singular value of the scaled J by coordinate errors of at most these half units.
///
/// By Weyl's inequality no singular value changes by more than the norm of the change of the matrix (Golub & Van Loan,
/// "Matrix Computations", 2013, 8.6.2). An error of its direction affects a turn directly, and also in its moment, at
/// an arm of at most the mechanism's size. The error of the point adds to this.
#[must_use]
pub(in crate::rank) fn bound(m: &Mechanism, closure: &Closure<f64>, half: &Uncertainties) -> f64 {
    let size = Scaling::of(closure).length();
    let error = |freedom: Freedom, j: JointId| {
        let (joint, at) = (&m.joints[j], j.index());
        let of = &joint.joint_type;
        let angle = |h: [f64; 3], v: &[Expr; 3]| norm(h) / norm(real(v));
        let axis = angle(half.axis[at], &joint.frame.axis);
        let length = norm(half.point[at]) / size;
        let turns = of.freedoms().iter().filter(|f| f.turns()).count();
        // Second axes are computed from two vectors.
        let own = match freedom {
            Freedom::Rz | Freedom::Tz | Freedom::Screw => axis,
            Freedom::Rx | Freedom::Ry | Freedom::Tx | Freedom::Ty => {
                axis + angle(half.reference[at], &joint.frame.reference)
            }
        };
        match freedom {
            Freedom::Tx | Freedom::Ty | Freedom::Tz => own,
            // Turns about a point are the same for any direction of its axes.
            Freedom::Rx | Freedom::Ry | Freedom::Rz if turns == 3 => length,
            Freedom::Screw => 2.0 * own + 2.0 * length + half.pitch[at] / size,
            _ => 2.0 * own + length,
        }
    };
    let squares = closure.columns.iter().map(|c| {
        let passing = closure.contours.iter();
        let passing = passing.filter(|k| k.direction(c.joint).is_some()).count();
        #[allow(clippy::cast_precision_loss, reason = "contours are few")]
        let times = passing as f64;
        times * error(c.freedom, c.joint).powi(2)
    });
    squares.sum::<f64>().sqrt()
}
