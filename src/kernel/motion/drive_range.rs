//! The full range of a drive, from one end to the other or through one turn, step by step.

use crate::geom::rigid::RigidMotion;
use crate::motion::follow::{Follower, Stop, column_slides, stroke_positions};
use crate::motion::pose::Pose;
use std::f64::consts::{PI, TAU};

/// The farthest distance that a slide is followed to either side, as a fraction of [`Pose::length`].
pub const SLIDE: f64 = 1.0;
/// Tolerance, in radians, within which a drive that reaches half a turn either way counts as fully rotating.
const ROUND: f64 = 1e-9;
/// Distance of links from their start below which the cycle is closed.
const BACK: f64 = 1e-6;

/// Share by which a range that ends early is shown short of its ends.
const SHORT: f64 = 1e-4;

/// Poses along the range of a drive.
#[derive(Debug, Clone)]
pub struct Way {
    /// Position of the drive in each pose: radians, or fractions of [`Pose::length`], from the pose of the file.
    pub at: Vec<f64>,
    /// The motion of each link since the pose of the file, pose by pose; see [`Pose::links`].
    pub links: Vec<Vec<RigidMotion>>,
    /// Index of the pose of the file, or of the nearest one.
    pub start: usize,
    /// Whether the last pose equals the first, after one turn of the drive.
    pub closed: bool,
    /// Reasons why the range ends at its beginning and at its end; `None` if it was not followed farther.
    pub ends: [Option<Stop>; 2],
}

/// Follows a mechanism to the ends of the range of a drive, with other drives held. A drive that rotates fully is
/// followed through one turn, and others from end to end. A slide is followed by at most the size of the mechanism to
/// either side. If a range is given, it is the limit. Steps of the drive are equal, but smaller towards an end that
/// stops it.
///
/// # Complexity
/// As [`Follower::advance`], for about ten poses per radian, three times.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, motion::{drive_range::follow_range, pose::Pose}};
/// let pose = Pose::of_file(&ozols::built_in("four-bar")?, StateId::FREE)?;
/// let way = follow_range(&pose, 0, &[], None, 36);
/// assert!(way.closed); // It is a crank: it turns fully.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn follow_range(
    pose: &Pose,
    drive: usize,
    held: &[usize],
    range: Option<[f64; 2]>,
    steps: usize,
) -> Way {
    let turns = !column_slides(pose, drive);
    let far = if turns { PI } else { SLIDE };
    let wanted = range.unwrap_or([-far, far]);
    let mut ends = [None, None];
    let mut reached = wanted;
    let mut go = |n: usize, to: f64| {
        let mut follower = Follower::new(pose.clone(), drive, held);
        reached[n] = to;
        if let Err(stop) = follower.advance_to(to, |_| {}) {
            (ends[n], reached[n]) = (Some(stop), stop.at);
        }
        ends[n].is_some()
    };
    let stopped = [go(0, wanted[0]), go(1, wanted[1])];
    // if the turn completes on one side only, it is followed on that side until it closes
    if range.is_none() && turns && stopped[0] != stopped[1] {
        let n = usize::from(stopped[0]);
        go(n, 2.0 * wanted[n]);
    }
    let round = range.is_none() && turns && reached.iter().all(|x| x.abs() > PI - ROUND);
    if round {
        let way = poses_along(pose, drive, held, [0.0, TAU], steps, ends);
        let (first, last) = (way.links.first(), way.links.last());
        let back = first
            .zip(last)
            .is_some_and(|(a, b)| a.iter().zip(b).all(|(a, b)| position_distance(a, b) < BACK));
        if back {
            return Way {
                closed: true,
                ..way
            };
        }
    }
    // the pose at the end of a range is hard to reach a second time
    let [from, to] = reached;
    for (n, end) in [0, 1].into_iter().zip([from, to]) {
        if ends[n].is_some() {
            reached[n] = end + SHORT * ((from + to) / 2.0 - end);
        }
    }
    poses_along(pose, drive, held, reached, steps, ends)
}

/// Returns the poses of a range that is known to be reachable.
fn poses_along(
    pose: &Pose,
    drive: usize,
    held: &[usize],
    range: [f64; 2],
    steps: usize,
    ends: [Option<Stop>; 2],
) -> Way {
    let stopped = ends.map(|e| e.is_some());
    let mut follower = Follower::new(pose.clone(), drive, held);
    let (mut at, mut links) = (Vec::new(), Vec::new());
    for to in stroke_positions([0.0, 1.0], steps) {
        let part = ease_part(to, stopped);
        let [from, last] = range;
        if follower
            .advance_to(from + part * (last - from), |_| {})
            .is_err()
        {
            break;
        }
        at.push(follower.drive_position());
        links.push(follower.current_pose().links);
    }
    let nearest = at
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    Way {
        start: nearest.map_or(0, |(i, _)| i),
        at,
        links,
        closed: false,
        ends,
    }
}

/// Returns a fraction of the range from equal fractions of a turn. Near an end that stops a drive, the other joints
/// move farther than the drive.
fn ease_part(part: f64, stopped: [bool; 2]) -> f64 {
    match stopped {
        [false, false] => part,
        [true, false] => 1.0 - (part * PI / 2.0).cos(),
        [false, true] => (part * PI / 2.0).sin(),
        [true, true] => (1.0 - (part * PI).cos()) / 2.0,
    }
}

/// Returns the distance between two positions of a link: radians, and fractions of [`Pose::length`].
fn position_distance(a: &RigidMotion, b: &RigidMotion) -> f64 {
    let shift = (0..3).map(|i| (a.translation[i] - b.translation[i]).abs());
    let turn = (0..9).map(|i| (a.rotation[i / 3][i % 3] - b.rotation[i / 3][i % 3]).abs());
    shift.chain(turn).fold(0.0, f64::max)
}
