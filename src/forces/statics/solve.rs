//! The joint reactions of any mechanism: in its plane if that determines them, otherwise in space.

use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::assur::AssurError;
use crate::statics::cycle::{PlanarStaticsError, Statics, planar_statics};
use crate::statics::planar::{PlanarError, loads_are_in_plane};
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::contact::{Contacts, object_at};
use crate::statics::reactions::cycle::{Cycle, solve_cycle};
use thiserror::Error;

/// The equations for a mechanism's reactions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// The equations of the plane, group by group and by the methods for four-link groups. An error if they do not
    /// determine the mechanism.
    Planar,
    /// All six components of each joint, including redundant constraints.
    Spatial,
    /// The equations of the plane if they determine the mechanism, all loads act in it and there are no contacts with a
    /// clamped part. Otherwise all six components.
    Either,
    /// All six components, with contacts with a clamped part that only push.
    Pushing,
}

/// Reactions over a stroke, or at one pose.
#[derive(Debug, Clone)]
pub enum SolvedReactions {
    /// From the equations of the plane.
    Planar(Box<Statics>),
    /// From the equations of space.
    Spatial(Cycle),
}

impl SolvedReactions {
    /// Returns true if every requested position was reached and has a solution.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        match self {
            SolvedReactions::Planar(s) => s.dead.is_none(),
            SolvedReactions::Spatial(c) => {
                c.stopped.is_none() && c.positions.iter().all(|(_, s)| s.is_ok())
            }
        }
    }
}

/// Reason why there are no reactions.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum StaticsError {
    /// The planar statics have no solution.
    #[error(transparent)]
    Planar(#[from] PlanarStaticsError),
    /// The spatial statics have no solution.
    #[error(transparent)]
    Spatial(#[from] Unsolved),
}

/// Returns true if the plane rejects a mechanism that the equations of space may solve.
pub(crate) fn is_for_space(error: &PlanarStaticsError) -> bool {
    match error {
        PlanarStaticsError::Planar(e) => !matches!(e, PlanarError::Exact(_)),
        PlanarStaticsError::Unsolved(_) => false,
        PlanarStaticsError::Assur(e) => matches!(e, AssurError::Overconstrained { .. }),
    }
}

/// Returns the reactions of a state under the loads of the file over a stroke of the first drive, from the pose of the
/// file. Without a stroke, only that pose is solved.
///
/// # Units
/// SI; the stroke in `[rad]` or the file's length unit.
///
/// # Errors
/// Returns a [`StaticsError`] if no pose has a solution. A stroke that ends early gives a [`SolvedReactions`] that is not complete.
///
/// # Complexity
/// O(n³) per position in the plane, for n bodies; O((6k)²·f) in space, for k contours and f freedoms.
///
/// # Examples
/// The parallel shears, held in their first position:
/// ```
/// use ozols::model::mechanism::StateId;
/// use ozols::statics::solve::{SolvedReactions, Model, solve_reactions};
///
/// let text = ozols::builtin::text("parallel-shears").expect("it is built in");
/// let shears = ozols::file::text::mechanism_from_str("parallel-shears.toml", text)?;
/// let SolvedReactions::Planar(found) = solve_reactions(&shears, StateId::FREE, None, Model::Either)? else {
///     panic!("the shears are planar")
/// };
/// assert_eq!(found.decomposition.highest_class(), 4);
/// assert_eq!(found.moments.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve_reactions(
    m: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
    model: Model,
) -> Result<SolvedReactions, StaticsError> {
    let touched = m.joints_in(state).any(|j| object_at(m, j).is_some());
    let (flat, contacts) = match model {
        Model::Planar => (true, Contacts::AsJoints),
        Model::Spatial => (false, Contacts::AsJoints),
        Model::Either => (!touched && loads_are_in_plane(m, state), Contacts::AsJoints),
        Model::Pushing => (false, Contacts::Pushing),
    };
    if flat {
        match planar_statics(m, state, stroke) {
            Ok(found) => return Ok(SolvedReactions::Planar(Box::new(found))),
            Err(e) if model == Model::Either && is_for_space(&e) => {}
            Err(e) => return Err(e.into()),
        }
    }
    Ok(SolvedReactions::Spatial(solve_cycle(
        m, state, stroke, contacts,
    )?))
}
