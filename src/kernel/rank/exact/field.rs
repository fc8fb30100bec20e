//! The prime fields in which the coordinates of a mechanism have values.

use crate::closure::coupling::{coefficient, coefficients, length_ratio};
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::model::mechanism::{Frame, JointOption, Mechanism, Mode, StateId};

/// Coordinates of a joint's frame.
pub(in crate::rank) fn coordinates(frame: &Frame) -> impl Iterator<Item = &Expr> {
    frame
        .point
        .iter()
        .chain(&frame.axis)
        .chain(&frame.reference)
        .chain([&frame.pitch])
}

/// Coordinates of the plane's normal, if there is one.
pub(in crate::rank) fn normal(mechanism: &Mechanism) -> &[Expr] {
    match &mechanism.mode {
        Mode::Spatial => &[],
        Mode::Planar { normal } => normal,
    }
}

/// The exact field of the joints present in a state, in the `nth` suitable prime.
///
/// # Errors
/// Where no prime suits, see [`ExactField`].
pub fn field_of(
    mechanism: &Mechanism,
    state: StateId,
    nth: usize,
) -> Result<ExactField, ExactError> {
    let frames = mechanism
        .joints_in(state)
        .map(|j| &mechanism.joints[j].frame);
    let couplings = coefficients(mechanism, state);
    let of_frames = frames.flat_map(coordinates);
    ExactField::for_expressions(of_frames.chain(normal(mechanism)).chain(&couplings), nth)
}

/// The exact field of a mechanism: all its coordinates, in the `nth` suitable prime.
///
/// # Errors
/// Where no prime suits, see [`ExactField`].
pub fn exact_field(mechanism: &Mechanism, nth: usize) -> Result<ExactField, ExactError> {
    let frames = mechanism.joints.iter().flat_map(|j| {
        std::iter::once(&j.frame)
            .chain(j.options.iter().map(|o| &o.frame))
            .chain(j.unloading.iter().map(|o| &o.frame))
    });
    let couplings = coupling_expressions(mechanism);
    let of_frames = frames.flat_map(coordinates);
    let others = normal(mechanism).iter().chain(&couplings);
    ExactField::for_expressions(of_frames.chain(others), nth)
}

/// What the rows of couplings need values of: their entries, for the present joints and for every option of them.
fn coupling_expressions(mechanism: &Mechanism) -> Vec<Expr> {
    let mut out = Vec::new();
    for coupling in &mechanism.couplings {
        out.push(coefficient(mechanism, coupling));
        for end in coupling.ends {
            let joint = &mechanism.joints[end.joint];
            let present = (&joint.frame, end.freedom);
            let length = |o: &JointOption| length_ratio((&o.frame, end.freedom), present);
            out.extend(joint.options.iter().map(length));
        }
    }
    out
}
