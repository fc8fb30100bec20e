//! Rank of the closure matrix, with what each method knows about its answer.

pub mod along_stroke;
pub mod auto;
pub mod certificate;
pub mod counting;
pub mod finite;
pub mod generic;
pub mod higher_order;
mod kernel;
pub mod loops;
pub mod lu;
pub mod measured;
pub mod method;
pub mod modular;
mod monomials;
pub mod numeric;
pub mod parts;
pub mod qr;
pub mod rational;
pub mod reconstruct;
pub mod scaled;
pub mod snap;
pub mod subgroup;
mod tangent_cone;
pub mod trace;

use crate::closure::coupling::coefficients;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::model::mechanism::{Frame, Mechanism, Mode, StateId};

/// Coordinates of a joint's frame.
pub(crate) fn coordinates(frame: &Frame) -> impl Iterator<Item = &Expr> {
    frame
        .point
        .iter()
        .chain(&frame.axis)
        .chain(&frame.reference)
        .chain([&frame.pitch])
}

/// Coordinates of the plane's normal, if there is one.
pub(crate) fn normal(mechanism: &Mechanism) -> &[Expr] {
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

/// How sure the rank of an analysis is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Certainty {
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
        /// The method's name.
        method: &'static str,
        /// Values below this fraction of the largest count as zero.
        tolerance: f64,
        /// The smallest kept value, relative to the largest.
        kept: f64,
        /// The largest dropped value, relative to the largest.
        dropped: f64,
    },
}

impl Certainty {
    /// One line for people.
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Certainty::Proven { primes: [p, q] } => format!(
                "exact geometry; rank proven by a checked certificate (--certificate), and modulo {p} and {q}"
            ),
            Certainty::Modular { primes: [p, q] } => {
                format!("exact geometry; ranks modulo {p} and {q} agree")
            }
            Certainty::Numeric {
                method,
                tolerance,
                kept,
                dropped,
            } => {
                let what = match *method {
                    "svd" => "f64 singular values",
                    "lu" => "f64 pivots",
                    "lu32" => "f32 pivots",
                    "qr32" => "f32 column-pivoted QR",
                    _ => "f64 column-pivoted QR",
                };
                format!(
                    "{what}, tolerance {tolerance:.0e}: smallest kept {kept:.1e}, largest dropped {dropped:.1e}"
                )
            }
        }
    }

    /// One word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Certainty::Proven { .. } => "proven",
            Certainty::Modular { .. } => "modular",
            Certainty::Numeric { .. } => "numeric",
        }
    }

    /// The method's name.
    #[must_use]
    pub fn method(&self) -> &'static str {
        match self {
            Certainty::Proven { .. } | Certainty::Modular { .. } => "modular",
            Certainty::Numeric { method, .. } => method,
        }
    }
}
