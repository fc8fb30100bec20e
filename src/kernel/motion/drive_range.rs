//! The whole way of a drive, from one end to the other or once round, step by step.

use crate::geom::rigid::RigidMotion;
use crate::motion::follow::{Follower, Stop, positions, slides};
use crate::motion::pose::Pose;
use std::f64::consts::{PI, TAU};

/// The farthest that a slide is followed to either side, as a fraction of [`Pose::length`].
pub const SLIDE: f64 = 1.0;
/// A drive that comes as near as this to half a turn either way is taken to go round, in radians.
const ROUND: f64 = 1e-9;
/// Links that come back so near to where they were have closed the cycle.
const BACK: f64 = 1e-6;

/// A way that ends before it is as long as asked for is shown short of its ends by this share.
const SHORT: f64 = 1e-4;

/// Poses along the way of a drive.
#[derive(Debug, Clone)]
pub struct Way {
    /// Position of the drive in each pose: radians, or fractions of [`Pose::length`], from the pose of the file.
    pub at: Vec<f64>,
    /// The motion of each link since the pose of the file, pose by pose; see [`Pose::links`].
    pub links: Vec<Vec<RigidMotion>>,
    /// Which of the poses is that of the file, or the nearest to it.
    pub start: usize,
    /// Whether the last pose is the first again, after one turn of the drive.
    pub closed: bool,
    /// Why the way ends where it does, at its beginning and at its end; `None` where it was not followed farther.
    pub ends: [Option<Stop>; 2],
}

/// Follows a mechanism to the ends of the way of a drive, other drives held: once round where the drive goes round, else
/// from end to end, a slide at most the size of the mechanism to either side. Where a range is given, only within it. Steps of the
/// drive are equal, but smaller towards an end where it stops.
///
/// # Complexity
/// As [`Follower::advance`], for some ten poses a radian three times over.
#[must_use]
pub fn way(
    pose: &Pose,
    drive: usize,
    held: &[usize],
    range: Option<[f64; 2]>,
    steps: usize,
) -> Way {
    let turns = !slides(pose, drive);
    let far = if turns { PI } else { SLIDE };
    let wanted = range.unwrap_or([-far, far]);
    let mut ends = [None, None];
    let mut reached = wanted;
    let mut go = |n: usize, to: f64| {
        let mut follower = Follower::new(pose.clone(), drive, held);
        reached[n] = to;
        if let Err(stop) = follower.advance(to, |_| {}) {
            (ends[n], reached[n]) = (Some(stop), stop.at);
        }
        ends[n].is_some()
    };
    let stopped = [go(0, wanted[0]), go(1, wanted[1])];
    // what goes round on one side only is followed on that side until it is round
    if range.is_none() && turns && stopped[0] != stopped[1] {
        let n = usize::from(stopped[0]);
        go(n, 2.0 * wanted[n]);
    }
    let round = range.is_none() && turns && reached.iter().all(|x| x.abs() > PI - ROUND);
    if round {
        let way = along(pose, drive, held, [0.0, TAU], steps, ends);
        let (first, last) = (way.links.first(), way.links.last());
        let back = first
            .zip(last)
            .is_some_and(|(a, b)| a.iter().zip(b).all(|(a, b)| apart(a, b) < BACK));
        if back {
            return Way {
                closed: true,
                ..way
            };
        }
    }
    // the pose at which a way ends is hard to come to a second time
    let [from, to] = reached;
    for (n, end) in [0, 1].into_iter().zip([from, to]) {
        if ends[n].is_some() {
            reached[n] = end + SHORT * ((from + to) / 2.0 - end);
        }
    }
    along(pose, drive, held, reached, steps, ends)
}

/// The poses of a range that has been seen to be within reach.
fn along(
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
    for to in positions([0.0, 1.0], steps) {
        let part = eased(to, stopped);
        let [from, last] = range;
        if follower
            .advance(from + part * (last - from), |_| {})
            .is_err()
        {
            break;
        }
        at.push(follower.at());
        links.push(follower.pose().links);
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

/// A part of a way, of equal parts of a turn: near an end that stops a drive, the others move farther than it.
fn eased(part: f64, stopped: [bool; 2]) -> f64 {
    match stopped {
        [false, false] => part,
        [true, false] => 1.0 - (part * PI / 2.0).cos(),
        [false, true] => (part * PI / 2.0).sin(),
        [true, true] => (1.0 - (part * PI).cos()) / 2.0,
    }
}

/// How far two places of a link are apart: radians, and fractions of [`Pose::length`].
fn apart(a: &RigidMotion, b: &RigidMotion) -> f64 {
    let shift = (0..3).map(|i| (a.translation[i] - b.translation[i]).abs());
    let turn = (0..9).map(|i| (a.rotation[i / 3][i % 3] - b.rotation[i / 3][i % 3]).abs());
    shift.chain(turn).fold(0.0, f64::max)
}
