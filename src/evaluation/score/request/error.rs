//! Why a request does not suit a mechanism, and why a search has no outcome.

use crate::file::problem::ImportError;
use crate::geom::exact::ExactError;
use crate::rank::method::NoAnswer;
use crate::score::evaluation::evaluate::ScoreError;
use crate::score::request::prepare::CURE;
use crate::search::check::second_prime::Disagreement;
use crate::search::question::conditions::SearchError;
use num_bigint::BigUint;
use thiserror::Error;

/// An error in a request about a mechanism.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RequestError {
    /// A pool that is none, or too large.
    #[error("the pool must be from 1 to {most} variants")]
    Pool {
        /// The largest pool.
        most: usize,
    },
    /// No such link.
    #[error("{mechanism} has no link {link} to hold")]
    NoLink {
        /// Name of the mechanism.
        mechanism: String,
        /// The link asked for.
        link: String,
    },
    /// No such joint.
    #[error("{mechanism} has no joint {joint}")]
    NoJoint {
        /// Name of the mechanism.
        mechanism: String,
        /// The joint asked for.
        joint: String,
    },
    /// No such option.
    #[error("no joint of {mechanism} has an option named {option}, and no joint type has that name; there are: {}", known.join(", "))]
    NoOption {
        /// Name of the mechanism.
        mechanism: String,
        /// The option asked for.
        option: String,
        /// The options that there are.
        known: Vec<String>,
    },
    /// A type that no joint can take.
    #[error(
        "{option} does not allow the motion that a joint of {mechanism} has now; name another type or other joints"
    )]
    LosesMotion {
        /// Name of the mechanism.
        mechanism: String,
        /// The type.
        option: String,
    },
    /// A joint to which nothing is allowed.
    #[error("name the options to allow at {joint}, such as {joint}=revolute,spherical")]
    NoNames {
        /// The joint.
        joint: String,
    },
    /// A type that cannot be put in series.
    #[error(
        "{word} is not a joint type that can be put in series at {joint}; there are: {}", known.join(", ")
    )]
    NoUnloading {
        /// The joint.
        joint: String,
        /// The word given.
        word: String,
        /// What there is.
        known: Vec<String>,
    },
    /// Unloading joints for a state that is not searched.
    #[error(
        "unloading joints {names} without a place go to the joints that a state adds; search a state, or name joints: {names}=JOINT"
    )]
    NoPlace {
        /// The names given.
        names: String,
    },
    /// A joint or link that takes no part.
    #[error("{item} of {mechanism} exists in state {} only; search state {}", states.join(", "), states[0])]
    Absent {
        /// Name of the mechanism.
        mechanism: String,
        /// The joint or link, such as "link a".
        item: String,
        /// The states it is in.
        states: Vec<String>,
    },
    /// Ranking by what only a state shows.
    #[error(
        "ranking by harmful constraints needs the state that adds them; search a state, such as {state}"
    )]
    HarmfulWhere {
        /// A state that there is.
        state: String,
    },
    /// No state to take joints from.
    #[error("{mechanism} has no state besides free")]
    OnlyFree {
        /// Name of the mechanism.
        mechanism: String,
    },
    /// No such state.
    #[error("{mechanism} has no state {state}; it has: {}", known.join(", "))]
    NoState {
        /// Name of the mechanism.
        mechanism: String,
        /// The state asked for.
        state: String,
        /// The states that there are.
        known: Vec<String>,
    },
    /// A file of costs that cannot be used.
    #[error("{0}")]
    Costs(#[from] ImportError),
    /// Orbits of variants that are judged by singular values.
    #[error(
        "one variant per symmetry orbit needs exact geometry, and these coordinates have none; {CURE}"
    )]
    NumericOrbits,
    /// The geometry has no image in a prime field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// Whether rounding matters could not be found.
    #[error(transparent)]
    Verdict(#[from] NoAnswer),
}

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
    /// Too many variants to examine each.
    #[error("{0} variants are too many for brute force; use the diagram, or fewer options")]
    TooMany(BigUint),
}
