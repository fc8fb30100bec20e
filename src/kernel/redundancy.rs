//! Mobility and redundant constraints: of the whole, contour by contour, and of the clamped object; which links idle;
//! what an over-constrained assembly is stressed with. The figures in short, for tables of many, stand here.

pub mod analysis;
pub mod contour_shares;
pub mod drives;
pub mod duplicate_constraints;
pub(crate) mod external;
pub mod idle_animation;
mod joint_wrench;
pub mod link_motion;
pub mod local_mobility;
pub mod measured;
pub mod motion;
pub mod other_poses;
pub mod release;
pub mod stress;
pub mod stress_loads;
pub mod stressed;

use crate::closure::Closure;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::NumericError;
use crate::redundancy::external::present_links;
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

/// What a state is in numbers.
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

/// The figures of a state.
///
/// # Guarantee
/// The rank is modulo one prime near 2^61; an analysis asks two and proves it.
///
/// # Errors
/// Where the geometry has no exact image.
pub fn figures(mechanism: &Mechanism, state: StateId) -> Result<StateFigures, ExactError> {
    let exact = field_of(mechanism, state, 0)?;
    let closure = Closure::new(&exact, mechanism, state)?;
    let rank = modular::rank(&exact, &closure);
    let joints: Vec<JointId> = mechanism.joints_in(state).collect();
    Ok(StateFigures {
        links: present_links(mechanism, &joints).len(),
        joints: joints.len(),
        contours: closure.contours.len(),
        freedoms: closure.columns.len(),
        mobility: closure.columns.len() - rank,
        redundant: closure.rows() - rank,
    })
}
