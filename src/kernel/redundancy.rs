//! Mobility and redundant constraints: of the whole mechanism, contour by contour, and of the clamped part. Also idle
//! links, and the self-stresses of an overconstrained assembly. This module has the short figures for tables of many
//! mechanisms.

pub mod analysis;
pub mod contour_shares;
pub mod duplicate_constraints;
pub(crate) mod external;
pub mod link_motion;
pub mod local_mobility;
pub mod motion;
pub mod other_poses;
pub mod release;
pub mod stress;
pub mod stress_loads;
pub mod stressed;

use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::closure_of;
use crate::rank::exact::modular;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::NumericError;
use thiserror::Error;

/// Reason why an analysis failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The geometry has no image in a prime field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The singular values could not be computed.
    #[error(transparent)]
    Numeric(#[from] NumericError),
    /// The automatic choice failed.
    #[error(transparent)]
    Auto(#[from] NoAnswer),
    /// A certificate proves a rank other than that modulo primes.
    #[error(
        "the rank of state {state} is {rank} modulo two primes, but a checked certificate proves {proven}; report this with the file"
    )]
    Refuted {
        /// The state.
        state: String,
        /// The rank modulo primes.
        rank: usize,
        /// The proven rank.
        proven: usize,
    },
    /// Two primes gave different ranks.
    #[error(
        "ranks modulo {first} and {second} differ in state {state}: {ranks:?}; report this with the file"
    )]
    Disagree {
        /// The state.
        state: String,
        /// The first prime.
        first: u64,
        /// The second prime.
        second: u64,
        /// Their ranks.
        ranks: [usize; 2],
    },
}

/// Figures of a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StateFigures {
    /// Links, n.
    pub links: usize,
    /// Joints, p.
    pub joints: usize,
    /// Independent contours, k.
    pub contours: usize,
    /// Freedoms, f.
    pub freedoms: usize,
    /// Mobility in this pose, W.
    pub mobility: usize,
    /// Redundant constraints, σ.
    pub redundant: usize,
}

/// Returns the figures of a state.
///
/// # Guarantee
/// The rank is modulo one prime near 2^61; an analysis uses two and proves it.
///
/// # Errors
/// Returns an error if the geometry has no exact image.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, redundancy::state_figures};
/// let gripper = state_figures(&ozols::built_in("gripper-10")?, StateId::FREE)?;
/// assert_eq!((gripper.mobility, gripper.redundant, gripper.contours), (1, 11, 4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn state_figures(mechanism: &Mechanism, state: StateId) -> Result<StateFigures, ExactError> {
    let (exact, closure) = closure_of(mechanism, state, 0)?;
    let rank = modular::rank_modulo(&exact, &closure);
    Ok(StateFigures {
        links: mechanism.links_in(state).count(),
        joints: mechanism.joints_in(state).count(),
        contours: closure.contours.len(),
        freedoms: closure.columns.len(),
        mobility: closure.columns.len() - rank,
        redundant: closure.rows() - rank,
    })
}
