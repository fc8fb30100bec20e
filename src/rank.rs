//! Rank of the closure matrix, with what each method knows about its answer.

pub mod auto;
pub mod certificate;
pub mod counting;
pub mod finite;
pub mod generic;
mod kernel;
pub mod loops;
pub mod lu;
pub mod measured;
pub mod method;
pub mod modular;
pub mod numeric;
pub mod qr;
pub mod rational;
pub mod reconstruct;
pub mod scaled;
pub mod second_order;
pub mod snap;
pub mod subgroup;
pub mod trace;

use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::model::mechanism::{Frame, Mechanism, Mode, StateId};

/// Coordinates of a joint's frame.
fn coordinates(frame: &Frame) -> impl Iterator<Item = &Expr> {
    frame
        .point
        .iter()
        .chain(&frame.axis)
        .chain(&frame.reference)
        .chain([&frame.pitch])
}

fn normal(mechanism: &Mechanism) -> &[Expr] {
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
    ExactField::for_expressions(frames.flat_map(coordinates).chain(normal(mechanism)), nth)
}

/// How sure an answer is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Certainty {
    /// Rank over two prime fields, on exact geometry. A rank modulo a prime never exceeds the true rank, and falls short
    /// only where the prime divides a nonzero minor; two primes near 2^61 agree on a wrong rank with probability
    /// below 10^-30.
    Modular {
        /// The primes.
        primes: [u64; 2],
    },
    /// Singular values in double precision.
    Numeric {
        /// Singular values below this fraction of the largest count as zero.
        tolerance: f64,
        /// The smallest kept singular value, relative to the largest.
        kept: f64,
        /// The largest dropped singular value, relative to the largest.
        dropped: f64,
    },
}

impl Certainty {
    /// One line for people.
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Certainty::Modular { primes: [p, q] } => {
                format!("exact geometry; ranks modulo {p} and {q} agree")
            }
            Certainty::Numeric {
                tolerance,
                kept,
                dropped,
            } => format!(
                "f64 singular values, tolerance {tolerance:.0e}: smallest kept {kept:.1e}, largest dropped {dropped:.1e}"
            ),
        }
    }

    /// One word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Certainty::Modular { .. } => "modular",
            Certainty::Numeric { .. } => "numeric",
        }
    }
}
