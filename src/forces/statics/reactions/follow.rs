//! Poses along the stroke of the first drive.

use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::follow::{Follower, slides};
use crate::motion::pose::Pose;
use crate::statics::reactions::drives::Driven;
use crate::statics::reactions::unsolved::Unsolved;

/// Greatest change of the drive between two poses that are closed: radians, or fractions of the mechanism's size.
const STEP: f64 = 0.05;

/// Poses by position of the drive, with the position it could not go on from, if any.
#[derive(Debug)]
pub struct Followed {
    /// Position of the drive since the pose of the file `[rad]` or in the file's unit, and the pose.
    pub poses: Vec<(f64, Pose)>,
    /// First position that could not be reached.
    pub stopped: Option<f64>,
}

/// The poses of a stroke, outward from that of the file on its branch; that of the file alone without a stroke. Freedoms
/// that no drive holds move as little as they need; of several drives the others keep step with the first by their speeds.
///
/// # Errors
/// Where a coordinate has no value.
///
/// # Complexity
/// O((6k)²·f) a Newton step, for k contours and f freedoms.
pub fn follow(
    m: &Mechanism,
    state: StateId,
    drives: &[Driven],
    stroke: Option<Stroke>,
) -> Result<Followed, Unsolved> {
    let wanted = stroke.map_or_else(|| vec![0.0], |s| s.positions());
    follow_to(m, state, drives, &wanted)
}

/// The poses at positions of the first drive, by position; that of the file alone where nothing is driven.
///
/// # Errors
/// Where a coordinate has no value.
pub fn follow_to(
    m: &Mechanism,
    state: StateId,
    drives: &[Driven],
    wanted: &[f64],
) -> Result<Followed, Unsolved> {
    let start = Pose::of_file(m, state)?;
    let column = drives.first().and_then(|d| {
        start
            .columns
            .iter()
            .position(|c| (c.joint, c.freedom) == *d)
    });
    let Some(column) = column else {
        return Ok(Followed {
            poses: vec![(0.0, start)],
            stopped: None,
        });
    };
    let held: Vec<usize> = drives
        .iter()
        .filter_map(|d| {
            let own = |c: &usize| (start.columns[*c].joint, start.columns[*c].freedom) == *d;
            (0..start.columns.len()).find(own)
        })
        .collect();
    let mut wanted = wanted.to_vec();
    wanted.sort_by(f64::total_cmp);
    let ahead: Vec<f64> = wanted.iter().copied().filter(|x| *x >= 0.0).collect();
    let back: Vec<f64> = wanted.iter().rev().copied().filter(|x| *x < 0.0).collect();
    let (mut poses, mut stopped) = (Vec::new(), None);
    for way in [ahead, back] {
        let found = match held[..] {
            [only] => alone(&start, only, &way),
            _ => in_step(&start, column, &held, &m.loads.drive_speeds, &way),
        };
        poses.extend(found.poses);
        stopped = stopped.or(found.stopped);
    }
    poses.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(Followed { poses, stopped })
}

/// Radians, or the file's unit of length, in a unit that a column moves by.
fn unit(pose: &Pose, column: usize) -> f64 {
    if slides(pose, column) {
        pose.length
    } else {
        1.0
    }
}

/// Follows the only drive from a pose to positions, each farther than the one before.
fn alone(start: &Pose, drive: usize, way: &[f64]) -> Followed {
    let mut out = Followed {
        poses: Vec::new(),
        stopped: None,
    };
    let mut follower = Follower::new(start.clone(), drive, &[]);
    for &to in way {
        if follower.advance(to / unit(start, drive), |_| {}).is_err() {
            out.stopped = Some(to);
            break;
        }
        out.poses.push((to, follower.pose()));
    }
    out
}

/// The same for the column of the first drive, all drives moving in the ratio of their speeds.
fn in_step(start: &Pose, first: usize, drives: &[usize], speeds: &[f64], way: &[f64]) -> Followed {
    let mut out = Followed {
        poses: Vec::new(),
        stopped: None,
    };
    let ratio = |n: usize| match (n, speeds.first(), speeds.get(n)) {
        (0, _, _) => 1.0,
        (_, Some(&first), Some(&own)) if first != 0.0 => own / first,
        _ => 0.0,
    };
    let (mut now, mut position) = (start.clone(), 0.0);
    for &to in way {
        let parts = ((to - position).abs() / unit(start, first) / STEP)
            .ceil()
            .max(1.0);
        let mut left = parts;
        while left > 0.0 {
            let mut q = vec![0.0; now.columns.len()];
            for (n, &c) in drives.iter().enumerate() {
                q[c] = ratio(n) * (to - position) / parts / unit(start, c);
            }
            let Ok(q) = now.close(q, drives) else {
                out.stopped = Some(to);
                return out;
            };
            now = now.moved(&q);
            left -= 1.0;
        }
        position = to;
        out.poses.push((to, now.clone()));
    }
    out
}
