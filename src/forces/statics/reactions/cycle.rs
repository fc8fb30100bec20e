//! Reactions over the stroke of the first drive.

use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::contact::Contacts;
use crate::statics::reactions::drives::{Driven, driven_freedoms};
use crate::statics::reactions::follow::follow_stroke;
use crate::statics::reactions::geometry::Geometry;
use crate::statics::reactions::loads::Borne;
use crate::statics::reactions::solution::Solution;
use crate::statics::reactions::unsolved::Unsolved;

/// Reactions by position of the first drive.
#[derive(Debug, Clone)]
pub struct Cycle {
    /// The freedoms that drives hold.
    pub drives: Vec<Driven>,
    /// Position of the first drive since the pose of the file, `[rad]` or the file's unit, and the reactions there.
    pub positions: Vec<(f64, Result<Solution, Unsolved>)>,
    /// The first position that could not be reached.
    pub stopped: Option<f64>,
}

/// Returns the reactions under the file's loads, including inertia forces of the stated drive speeds, over a stroke or
/// at the pose of the file.
///
/// # Errors
/// Returns an [`Unsolved`] if no pose has a solution.
///
/// # Complexity
/// O((6k)²·f) per pose, for k contours and f freedoms.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, statics::reactions::cycle::solve_cycle};
/// let found = solve_cycle(&ozols::built_in("gripper-10-loaded")?, StateId::FREE, None)?;
/// assert_eq!((found.positions.len(), found.stopped), (1, None)); // The pose of the file alone.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve_cycle(
    m: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
) -> Result<Cycle, Unsolved> {
    cycle_with(m, state, stroke, Contacts::AsJoints)
}

/// Returns the reactions with the requested treatment of contacts.
///
/// # Errors
/// Returns an error in the same cases as [`cycle`].
pub(crate) fn cycle_with(
    m: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
    contacts: Contacts,
) -> Result<Cycle, Unsolved> {
    let home = Pose::of_file(m, state)?;
    let drives = driven_freedoms(m, &Geometry::new(m, state, &home)?)?;
    let followed = follow_stroke(m, state, &drives, stroke)?;
    let each = followed.poses.iter();
    let positions: Vec<_> = each
        .map(|(at, pose)| {
            (
                *at,
                Borne::new(m, state, pose, *at, &drives)
                    .and_then(|borne| borne.solve_loads(m, &drives, contacts)),
            )
        })
        .collect();
    if let [(_, Err(e)), rest @ ..] = &positions[..]
        && rest.iter().all(|(_, s)| s.is_err())
    {
        return Err(e.clone());
    }
    Ok(Cycle {
        drives,
        positions,
        stopped: followed.stopped,
    })
}
