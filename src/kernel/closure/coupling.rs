//! Couplings as rows of the closure matrix.
//!
//! A column of J is the twist of a freedom about or along an axis of any length. So a speed of 1 is a rate of that
//! length in radians or length units. A coupling relates rates, and its row cancels the lengths: s_b -
//! ratio·(|a|/|b|)·s_a = 0 for speeds s on axes a and b.

use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::geom::expr::Expr;
use crate::model::joint_type::{Coupling, Freedom};
use crate::model::mechanism::{Frame, JointId, Mechanism, Parts, StateId};

/// Relative difference of squared lengths below which two axes, written in decimals, have the same length.
const UNIT: f64 = 1e-12;

/// Bits in a squared length, numerator and denominator, above which its root is replaced by a decimal.
const LONG: u64 = 64;

/// Returns the squared length of the axis of a freedom; see [`super::twist::FrameValues`].
pub(super) fn squared_axis_length(frame: &Frame, freedom: Freedom) -> Expr {
    let dot = |a: &[Expr; 3], b: &[Expr; 3]| &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2];
    let z = || dot(&frame.axis, &frame.axis);
    // x = r (z·z) - z (z·r), so x·x = (z·z)((z·z)(r·r) - (z·r)²); y = z × x.
    let x = || {
        let (r, zr) = (&frame.reference, dot(&frame.axis, &frame.reference));
        let zz = z();
        &zz * &(&zz * &dot(r, r) - &zr * &zr)
    };
    match freedom {
        Freedom::Rz | Freedom::Tz | Freedom::Screw => z(),
        Freedom::Rx | Freedom::Tx => x(),
        Freedom::Ry | Freedom::Ty => z() * x(),
    }
}

/// Returns the length of the axis of a freedom in one frame over that in another. The ratio is 1 if they differ only by
/// rounding, and a decimal if axes of many digits have no short root.
#[must_use]
pub fn length_ratio(of: (&Frame, Freedom), over: (&Frame, Freedom)) -> Expr {
    let (a, b) = (
        squared_axis_length(of.0, of.1),
        squared_axis_length(over.0, over.1),
    );
    let ratio = a.to_f64() / b.to_f64();
    if (ratio - 1.0).abs() < UNIT {
        return Expr::from(1);
    }
    // Axes are nonzero, so the quotient and its root exist.
    let exact = a.div(&b).and_then(|q| {
        let root = q.sqrt()?;
        let long = q
            .as_rational()
            .is_some_and(|q| q.numer().bits() + q.denom().bits() > LONG);
        (root.as_rational().is_some() || !long).then_some(root)
    });
    // Axes of many decimals are measured or rounded. Their lengths are at most as accurate as a double.
    exact
        .or_else(|| Expr::from_f64(ratio.sqrt()).ok())
        .unwrap_or_else(|| Expr::from(1))
}

/// Returns the entry of a coupling's row at the speed of its first freedom, with the entry of the second scaled to 1.
#[must_use]
pub fn coupling_coefficient(mechanism: &Parts, coupling: &Coupling) -> Expr {
    let [a, b] = coupling.ends;
    let frame = |j: JointId| &mechanism.joints[j].frame;
    let length = length_ratio((frame(a.joint), a.freedom), (frame(b.joint), b.freedom));
    -(&coupling.ratio * &length)
}

/// Returns the entries of all couplings of a state, for the field in which they need values.
#[must_use]
pub fn coupling_coefficients(mechanism: &Mechanism, state: StateId) -> Vec<Expr> {
    mechanism
        .couplings_in(state)
        .map(|c| coupling_coefficient(mechanism, c))
        .collect()
}

/// Returns true if a freedom on its own stays in the space of the mechanism's mode.
#[must_use]
pub fn in_plane(mechanism: &Parts, joint: JointId, freedom: Freedom) -> bool {
    let stays = || {
        let space = MotionSpace::new(&Reals, &mechanism.mode)?;
        let frame = FrameValues::new(&Reals, &mechanism.joints[joint].frame)?;
        let twist = frame.twist_of(&Reals, freedom);
        Ok::<_, ExactError>(space.components_in_space(&Reals, &twist).is_some())
    };
    stays().unwrap_or(false)
}
