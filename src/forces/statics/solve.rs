//! The joint reactions of any mechanism: in its plane where that determines them, otherwise in space.

use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::assur::AssurError;
use crate::statics::cycle::{PlanarStaticsError, Statics, statics};
use crate::statics::planar::{PlanarError, loads_are_in_plane};
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::contact::{Contacts, object_at};
use crate::statics::reactions::cycle::{Cycle, cycle_with};
use thiserror::Error;

/// Which equations a mechanism's reactions come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// Those of its plane, group by group and by the methods for four-link groups; refused where they do not determine it.
    Planar,
    /// All six components of each joint, redundant constraints and all.
    Spatial,
    /// Those of the plane where they determine it, all loads act in it and there are no contacts with an object, otherwise all
    /// six.
    Either,
    /// All six, and contacts with an object only push.
    Pushing,
}

/// Reactions over a stroke, or at one pose.
#[derive(Debug, Clone)]
pub enum SolvedReactions {
    /// By the equations of the plane.
    Planar(Box<Statics>),
    /// By those of space.
    Spatial(Cycle),
}

impl SolvedReactions {
    /// Whether every position asked for was reached and has a solution.
    #[must_use]
    pub fn complete(&self) -> bool {
        match self {
            SolvedReactions::Planar(s) => s.dead.is_none(),
            SolvedReactions::Spatial(c) => {
                c.stopped.is_none() && c.positions.iter().all(|(_, s)| s.is_ok())
            }
        }
    }
}

/// Why there are no reactions.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum StaticsError {
    /// In the plane.
    #[error(transparent)]
    Planar(#[from] PlanarStaticsError),
    /// In space.
    #[error(transparent)]
    Spatial(#[from] Unsolved),
}

/// Whether the plane refuses a mechanism that the equations of space may solve.
pub(crate) fn is_for_space(error: &PlanarStaticsError) -> bool {
    match error {
        PlanarStaticsError::Planar(e) => !matches!(e, PlanarError::Exact(_)),
        PlanarStaticsError::Unsolved(_) => false,
        PlanarStaticsError::Assur(e) => matches!(e, AssurError::Overconstrained { .. }),
    }
}

/// Reactions of a state under the loads of the file over a stroke of the first drive, from the pose of the file; without
/// one at that pose alone.
///
/// # Units
/// SI; the stroke in `[rad]` or the file's length unit.
///
/// # Errors
/// [`StaticsError`], where no pose has a solution. A stroke that ends early is an [`SolvedReactions`] that is not complete.
///
/// # Complexity
/// O(n³) a position in the plane, n bodies; O((6k)²·f) in space, k contours and f freedoms.
///
/// # Examples
/// The parallel shears, held in their first position:
/// ```
/// use ozols::model::mechanism::StateId;
/// use ozols::statics::solve::{SolvedReactions, Model, solve};
///
/// let text = ozols::builtin::text("parallel-shears").expect("it is built in");
/// let shears = ozols::file::text::mechanism_from_str("parallel-shears.toml", text)?;
/// let SolvedReactions::Planar(found) = solve(&shears, StateId::FREE, None, Model::Either)? else {
///     panic!("the shears are planar")
/// };
/// assert_eq!(found.decomposition.class(), 4);
/// assert_eq!(found.moments.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve(
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
        match statics(m, state, stroke) {
            Ok(found) => return Ok(SolvedReactions::Planar(Box::new(found))),
            Err(e) if model == Model::Either && is_for_space(&e) => {}
            Err(e) => return Err(e.into()),
        }
    }
    Ok(SolvedReactions::Spatial(cycle_with(
        m, state, stroke, contacts,
    )?))
}
