//! Reactions over the stroke of the first drive.

use crate::closure::drive::{Driven, driven_freedoms};
use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::follow::{Follower, column_unit};
use crate::motion::pose::Pose;
use crate::statics::reactions::contact::Contacts;
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
/// at the pose of the file, with a treatment of contacts.
///
/// # Errors
/// Returns an [`Unsolved`] if no pose has a solution.
///
/// # Complexity
/// O((6k)²·f) per pose, for k contours and f freedoms.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, statics::reactions::{Contacts, cycle::solve_cycle}};
/// let loaded = ozols::built_in("gripper-10-loaded")?;
/// let found = solve_cycle(&loaded, StateId::FREE, None, Contacts::AsJoints)?;
/// assert_eq!((found.positions.len(), found.stopped), (1, None)); // The pose of the file alone.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve_cycle(
    m: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
    contacts: Contacts,
) -> Result<Cycle, Unsolved> {
    let drives = driven_freedoms(m, state);
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

/// Poses by position of the drive, with the position at which it stopped, if any.
#[derive(Debug)]
pub struct Followed {
    /// Position of the drive since the pose of the file `[rad]` or in the file's unit, and the pose.
    pub poses: Vec<(f64, Pose)>,
    /// First position that could not be reached.
    pub stopped: Option<f64>,
    /// The position of the drive at which it stopped, and the pose.
    pub last: Option<(f64, Pose)>,
}

/// Returns the poses of a stroke, outward from that of the file on its branch, or only that of the file without a
/// stroke. Freedoms that no drive holds move as little as possible. With several drives, the others keep step with the
/// first by their speeds.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// # Complexity
/// O((6k)²·f) per Newton step, for k contours and f freedoms.
pub fn follow_stroke(
    m: &Mechanism,
    state: StateId,
    drives: &[Driven],
    stroke: Option<Stroke>,
) -> Result<Followed, Unsolved> {
    let wanted = stroke.map_or_else(|| vec![0.0], |s| s.positions());
    follow_to(m, state, drives, &wanted)
}

/// Returns the poses at positions of the first drive, by position, or only that of the file if nothing is driven.
///
/// # Errors
/// Returns an error if a coordinate has no value.
pub fn follow_to(
    m: &Mechanism,
    state: StateId,
    drives: &[Driven],
    wanted: &[f64],
) -> Result<Followed, Unsolved> {
    let mut start = Pose::of_file(m, state)?;
    let columns = start.columns.iter().map(|c| (c.joint, c.freedom));
    let columns: Vec<Driven> = columns.collect();
    let held = drives
        .iter()
        .filter_map(|d| columns.iter().position(|c| c == d));
    let held: Vec<usize> = held.collect();
    let mut out = Followed {
        poses: Vec::new(),
        stopped: None,
        last: None,
    };
    let Some((&first, others)) = held.split_first() else {
        out.poses.push((0.0, start));
        return Ok(out);
    };
    let unit = column_unit(&start, first);
    let speeds = &m.loads.drive_speeds;
    let mut still = Vec::new();
    for (n, &c) in others.iter().enumerate() {
        match (speeds.first(), speeds.get(n + 1)) {
            (Some(&v), Some(&own)) if v != 0.0 && own != 0.0 => {
                let ratio = own / v * unit / column_unit(&start, c);
                start = start.with_coupling(first, c, ratio);
            }
            _ => still.push(c),
        }
    }
    let mut wanted = wanted.to_vec();
    wanted.sort_by(f64::total_cmp);
    let (back, ahead): (Vec<f64>, Vec<f64>) = wanted.into_iter().partition(|x| *x < 0.0);
    for way in [ahead, back.into_iter().rev().collect()] {
        let mut follower = Follower::new(start.clone(), first, &still);
        for to in way {
            if follower.advance_to(to / unit, |_| {}).is_err() {
                if out.stopped.is_none() {
                    out.stopped = Some(to);
                    out.last = Some((follower.drive_position() * unit, follower.current_pose()));
                }
                break;
            }
            out.poses.push((to, follower.current_pose()));
        }
    }
    out.poses.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(out)
}
