//! Why a search has no outcome.

use crate::geom::exact::ExactError;
use crate::score::evaluation::evaluate::ScoreError;
use crate::score::request::RequestError;
use crate::search::check::second_prime::Disagreement;
use crate::search::question::conditions::SearchError;
use num_bigint::BigUint;
use thiserror::Error;

/// Why a search has no outcome.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunError {
    /// The request does not suit the mechanism.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// The geometry has no image in a prime field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The search could not be made.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// Two primes give different answers.
    #[error(transparent)]
    Disagreement(#[from] Box<Disagreement>),
    /// The variants cannot be ranked.
    #[error("cannot score variants of {mechanism}: {why}")]
    Score {
        /// Name of the mechanism.
        mechanism: String,
        /// Why not.
        why: ScoreError,
    },
    /// Too many variants to look at each.
    #[error("{0} variants are too many for brute force; use --method diagram, or fewer --options")]
    TooMany(BigUint),
}
