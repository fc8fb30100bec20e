//! The prime fields in which the coordinates of a mechanism have values.

use crate::closure::Closure;
use crate::closure::coupling::{coupling_coefficient, coupling_coefficients, length_ratio};
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{Frame, JointOption, Mechanism, Mode, StateId};

/// Returns the coordinates of some joints' frames and of the plane's normal, with the entries of coupling rows.
fn all_expressions<'m>(
    mechanism: &'m Mechanism,
    frames: impl Iterator<Item = &'m Frame>,
    couplings: Vec<Expr>,
) -> Vec<Expr> {
    let normal: &[Expr] = match &mechanism.mode {
        Mode::Spatial => &[],
        Mode::Planar { normal } => normal,
    };
    let of_frames = frames.flat_map(|f| f.vectors().into_iter().flatten().chain([&f.pitch]));
    let own = of_frames.chain(normal).cloned();
    own.chain(couplings).collect()
}

/// Returns the expressions of the joints present in a state, for the field in which they need values.
pub(in crate::rank) fn expressions_in(mechanism: &Mechanism, state: StateId) -> Vec<Expr> {
    let joints = mechanism.joints_in(state);
    let frames = joints.map(|j| &mechanism.joints[j].frame);
    all_expressions(mechanism, frames, coupling_coefficients(mechanism, state))
}

/// Returns the exact field of the joints present in a state, in the `nth` suitable prime.
///
/// # Errors
/// Returns an error if no prime is suitable, see [`ExactField`].
///
/// # Examples
/// ```
/// use ozols::{closure::Closure, model::mechanism::StateId};
/// use ozols::rank::exact::{field::field_of, modular::rank_modulo};
/// let gripper = ozols::built_in("gripper-10")?;
/// let exact = field_of(&gripper, StateId::FREE, 0)?;
/// let j = Closure::new(&exact, &gripper, StateId::FREE)?;
/// assert_eq!(rank_modulo(&exact, &j), 13); // Of 24 rows, so σ = 11.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn field_of(
    mechanism: &Mechanism,
    state: StateId,
    nth: usize,
) -> Result<ExactField, ExactError> {
    ExactField::for_expressions(&expressions_in(mechanism, state), nth)
}

/// Returns the exact field of the joints present in a state, and J of the state in it.
///
/// # Errors
/// Returns an error if no prime is suitable, see [`ExactField`].
pub(crate) fn closure_of(
    mechanism: &Mechanism,
    state: StateId,
    nth: usize,
) -> Result<(ExactField, Closure<Residue>), ExactError> {
    let exact = field_of(mechanism, state, nth)?;
    let closure = Closure::new(&exact, mechanism, state)?;
    Ok((exact, closure))
}

/// Returns the exact field of a mechanism for all its coordinates, in the `nth` suitable prime.
///
/// # Errors
/// Returns an error if no prime is suitable, see [`ExactField`].
///
/// # Examples
/// ```
/// use ozols::rank::exact::field::exact_field;
/// let gripper = ozols::built_in("gripper-10")?;
/// let primes = [0, 1].map(|nth| exact_field(&gripper, nth).map(|f| f.field().modulus()));
/// assert!(matches!(primes, [Ok(one), Ok(other)] if one != other));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn exact_field(mechanism: &Mechanism, nth: usize) -> Result<ExactField, ExactError> {
    let frames = mechanism.joints.iter().flat_map(|j| {
        std::iter::once(&j.frame)
            .chain(j.options.iter().map(|o| &o.frame))
            .chain(j.unloading.iter().map(|o| &o.frame))
    });
    let all = all_expressions(mechanism, frames, coupling_expressions(mechanism));
    ExactField::for_expressions(&all, nth)
}

/// Returns the entries of the coupling rows, for the original joints and for each of their options.
fn coupling_expressions(mechanism: &Mechanism) -> Vec<Expr> {
    let mut out = Vec::new();
    for coupling in &mechanism.couplings {
        out.push(coupling_coefficient(mechanism, coupling));
        for end in coupling.ends {
            let joint = &mechanism.joints[end.joint];
            let present = (&joint.frame, end.freedom);
            let length = |o: &JointOption| length_ratio((&o.frame, end.freedom), present);
            out.extend(joint.options.iter().map(length));
        }
    }
    out
}
