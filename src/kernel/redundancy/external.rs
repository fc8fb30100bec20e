//! The external constraints that a clamped part, or any other state, adds to the free mechanism.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::exact::modular;
use crate::rank::method::to_i64;
use crate::redundancy::motion::Speeds;
use serde::Serialize;

/// The external constraints of a state, counted and by rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct External {
    /// Σα: constraints of the joints that the state adds, and their couplings, less those of the joints it omits.
    pub constraints: i64,
    /// W_a: mobility without the clamped part.
    pub actual_mobility: i64,
    /// W_r: mobility of the mechanism's own joints with the clamped part.
    pub working_mobility: i64,
    /// w_a: mobilities that the added bodies lose.
    pub lost_mobility: i64,
    /// σ_a by the external formula, Σα - (W_a - W_r) - w_a.
    pub redundant: i64,
    /// σ of the state less σ of the free state, by ranks.
    #[serde(rename = "redundant_by_rank")]
    pub by_rank: i64,
}

/// Returns the external constraints of the state of `closure`; `kernel` is a basis of its motions.
pub(super) fn external_constraints(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
) -> Result<External, ExactError> {
    let free = Closure::new(exact, mechanism, StateId::FREE)?;
    let free_rank = modular::rank_modulo(exact, &free);
    let rank = modular::rank_modulo(exact, closure);
    let own: Vec<JointId> = mechanism.joints_in(StateId::FREE).collect();
    let all: Vec<JointId> = mechanism.joints_in(closure.state).collect();
    let added = || mechanism.joints_added_in(closure.state);
    let of_joints: i64 = added()
        .map(|j| to_i64(closure.dim) - to_i64(freedoms_of(closure, j)))
        .sum();
    let left_out = own.iter().filter(|j| !all.contains(j));
    let of_joints = of_joints
        - left_out
            .map(|&j| to_i64(closure.dim) - to_i64(freedoms_of(&free, j)))
            .sum::<i64>();
    let constraints = of_joints + to_i64(closure.couplings.len()) - to_i64(free.couplings.len());
    let links = |state| to_i64(mechanism.links_in(state).count());
    let bodies = links(closure.state) - links(StateId::FREE);
    // The mechanism's own part of each motion.
    let mut span = Echelon::new(exact.field());
    for speeds in kernel {
        let part: Vec<Residue> = speeds
            .iter()
            .zip(&closure.columns)
            .map(|(&s, c)| if own.contains(&c.joint) { s } else { 0 })
            .collect();
        span.insert(&part);
    }
    let (actual, working) = (to_i64(free.columns.len() - free_rank), to_i64(span.rank()));
    let lost = to_i64(closure.dim) * bodies - (to_i64(kernel.len()) - working);
    Ok(External {
        constraints,
        actual_mobility: actual,
        working_mobility: working,
        lost_mobility: lost,
        redundant: constraints - (actual - working) - lost,
        by_rank: to_i64(closure.rows() - rank) - to_i64(free.rows() - free_rank),
    })
}

pub(super) fn freedoms_of(closure: &Closure<Residue>, joint: JointId) -> usize {
    closure.columns.iter().filter(|c| c.joint == joint).count()
}
