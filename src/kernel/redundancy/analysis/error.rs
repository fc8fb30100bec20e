//! Why an analysis fails.

use crate::geom::exact::ExactError;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::NumericError;
use thiserror::Error;

/// Why an analysis failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The geometry has no image in a prime field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// No singular values.
    #[error(transparent)]
    Numeric(#[from] NumericError),
    /// The automatic choice failed.
    #[error(transparent)]
    Auto(#[from] NoAnswer),
    /// A certificate proves another rank than primes gave.
    #[error(
        "the rank of state {state} is {rank} modulo two primes, but a checked certificate proves {proven}; report this with the file"
    )]
    Refuted {
        /// The state.
        state: String,
        /// The rank modulo primes.
        rank: usize,
        /// The rank that is proven.
        proven: usize,
    },
    /// Two primes gave different ranks.
    #[error(
        "ranks modulo {first} and {second} differ in state {state}: {ranks:?}; report this with the file"
    )]
    Disagree {
        /// The state.
        state: String,
        /// One prime.
        first: u64,
        /// The other.
        second: u64,
        /// Their ranks.
        ranks: [usize; 2],
    },
}
