//! The figures of a mechanism in short: for tables of many, where nothing else is asked.

use crate::closure::matrix::Closure;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::redundancy::external::present_links;

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
