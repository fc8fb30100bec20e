//! The external constraints that a clamped part, or any other state, adds to the free mechanism.

use crate::closure::{Closure, Column};
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::exact::modular;
use crate::rank::method::to_i64;
use crate::redundancy::contour_shares::Measured;
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

impl External {
    /// Returns the external constraints of a state, given J of the free state and of this one, the mobilities by the rank
    /// of each, and the mobility of the mechanism's own joints in this state.
    fn new<N: Clone + Default + PartialEq>(
        mechanism: &Mechanism,
        [free, here]: [&Closure<N>; 2],
        mobilities: [usize; 2],
        working: usize,
    ) -> External {
        let more = |count: &dyn Fn(&Closure<N>) -> usize| to_i64(count(here)) - to_i64(count(free));
        let bodies = more(&|c| mechanism.links_in(c.state).count());
        let joints = more(&|c| mechanism.joints_in(c.state).count());
        let freedoms = more(&|c| c.columns.len());
        let dim = to_i64(here.dim);
        let constraints = dim * joints - freedoms + more(&|c| c.couplings.len());
        let [actual, all] = mobilities.map(to_i64);
        let working = to_i64(working);
        let lost = dim * bodies - (all - working);
        External {
            constraints,
            actual_mobility: actual,
            working_mobility: working,
            lost_mobility: lost,
            redundant: constraints - (actual - working) - lost,
            by_rank: more(&|c| c.rows()) + all - actual - freedoms,
        }
    }
}

/// Returns the external constraints of the state of `closure`; `kernel` is a basis of its motions.
pub(super) fn external_constraints(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
) -> Result<External, ExactError> {
    let free = Closure::new(exact, mechanism, StateId::FREE)?;
    let actual = free.columns.len() - modular::rank_modulo(exact, &free);
    // The mechanism's own part of each motion.
    let own = |c: &Column<Residue>| mechanism.joints[c.joint].is_in(StateId::FREE);
    let part = |speeds: &Speeds| -> Vec<Residue> {
        let each = speeds.iter().zip(&closure.columns);
        each.map(|(&s, c)| if own(c) { s } else { 0 }).collect()
    };
    let working = Echelon::from_vectors(exact.field(), kernel.iter().map(part)).rank();
    let mobilities = [actual, kernel.len()];
    Ok(External::new(
        mechanism,
        [&free, closure],
        mobilities,
        working,
    ))
}

/// Returns the external constraints by singular values, or `None` if the ranks of the two states at the tolerance
/// contradict each other.
pub(super) fn external_measured(
    mechanism: &Mechanism,
    here: &Measured<'_>,
    tolerance: f64,
) -> Result<Option<External>, ExactError> {
    let free = Measured::new(mechanism, StateId::FREE, tolerance)?;
    let own: Vec<JointId> = mechanism.joints_in(StateId::FREE).collect();
    let mobilities = [free.mobility(), here.mobility()];
    let working = here.span_of_joints(&own);
    let found = External::new(
        mechanism,
        [&free.closure, &here.closure],
        mobilities,
        working,
    );
    Ok(Some(found).filter(|x| x.redundant == x.by_rank))
}
