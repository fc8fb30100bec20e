//! Rank of the closure matrix, with what each method knows about its answer.

pub mod finite;
pub mod measured;
pub mod modular;
pub mod numeric;
pub mod second_order;
pub mod subgroup;
pub mod trace;
pub mod certificate;
mod kernel;
pub mod rational;
pub mod reconstruct;

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
