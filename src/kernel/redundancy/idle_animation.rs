//! An idle freedom as a visible motion: back and forth by a small amount, along the motion that the analysis lists.
//!
//! The analysis finds idle motions modulo a prime, where numbers have no size. Here the same motions are found among
//! the null vectors of J by the links at rest in them. They are closed by Newton's method if a finite motion follows
//! them.

use crate::closure::tree::path_from_frame;
use crate::geom::exact::ExactError;
use crate::geom::rigid::RigidMotion;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::motion::drive_range::Way;
use crate::motion::pose::{FLAT, Pose};
use crate::redundancy::local_mobility::Idle;
use ozols_dense::{add_scaled, difference, dot, largest, norm, svd};
use std::f64::consts::TAU;

/// The largest coordinate of the animation: radians, or fractions of [`Pose::length`].
pub const FAR: f64 = 0.35;
/// Number of poses of the animation.
const STEPS: usize = 48;
/// Share of a step beyond which a closed pose is too far from the first-order prediction and belongs to another motion.
const ASTRAY: f64 = 0.5;

/// An idle freedom as an animation.
#[derive(Debug, Clone)]
pub struct Wiggle {
    /// The poses, once back and forth.
    pub way: Way,
    /// Whether every pose closes. If not, the poses follow the motion to first order, and parts separate to second
    /// order.
    pub closed: bool,
}

/// Returns one of the idle motions of a state, or `None` if the numerical null vectors do not show it.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// # Complexity
/// Singular values of a matrix of six rows per contour and per link at rest, for each motion up to the requested one.
/// Then one closure per pose.
pub fn wiggle(
    mechanism: &Mechanism,
    state: StateId,
    idle: &[Idle],
    which: usize,
) -> Result<Option<Wiggle>, ExactError> {
    let pose = Pose::of_file(mechanism, state)?;
    let Some(speeds) = speeds(mechanism, state, &pose, idle, which) else {
        return Ok(None);
    };
    let largest = largest(&speeds);
    // links at rest in it stay at rest throughout
    let moving = |l: &LinkId| idle[which].links.contains(l);
    let rests = |&c: &usize| {
        !mechanism.joints[pose.columns[c].joint]
            .links
            .iter()
            .any(moving)
    };
    let held: Vec<usize> = (0..speeds.len()).filter(rests).collect();
    let mut closed = true;
    let mut at = Vec::new();
    let mut links = Vec::new();
    for step in 0..=STEPS {
        let far = FAR * (TAU * step as f64 / STEPS as f64).sin();
        let ahead: Vec<f64> = speeds.iter().map(|x| x * far / largest).collect();
        let near = |q: &Vec<f64>| norm(&difference(q, &ahead)) <= ASTRAY * norm(&ahead);
        let found = pose.close(ahead.clone(), &held).ok().filter(near);
        closed &= found.is_some();
        let mut there = pose.moved(&found.unwrap_or(ahead)).links;
        // they are connected to moving links, within the closure tolerance
        for l in mechanism.link_ids().filter(|l| !moving(l)) {
            there[l.index()] = RigidMotion::IDENTITY;
        }
        links.push(there);
        at.push(far);
    }
    let way = Way {
        at,
        links,
        start: 0,
        closed: true,
        ends: [None, None],
    };
    Ok(Some(Wiggle { way, closed }))
}

/// Returns the speeds of one of the motions: the null vectors under which the same links are at rest, less the earlier
/// motions of some of these links.
fn speeds(
    mechanism: &Mechanism,
    state: StateId,
    pose: &Pose,
    idle: &[Idle],
    which: usize,
) -> Option<Vec<f64>> {
    let mut before: Vec<(&[LinkId], Vec<f64>)> = Vec::new();
    for motion in &idle[..=which] {
        let resting = mechanism
            .link_ids()
            .filter(|l| !motion.links.contains(l))
            .map(|l| path_from_frame(mechanism, state, l));
        let resting: Vec<Vec<(JointId, bool)>> = resting.filter(|p| !p.is_empty()).collect();
        let svd = svd(&pose.jacobian_with(&resting, &[]))?;
        let null = svd.null_space(svd.rank(FLAT));
        let within = |links: &[LinkId]| links.iter().all(|l| motion.links.contains(l));
        let candidates = (0..null.ncols()).map(|c| {
            let mut v = null.col(c).to_vec();
            for (_, other) in before.iter().filter(|(links, _)| within(links)) {
                v = add_scaled(&v, -dot(&v, other), other);
            }
            let size = norm(&v);
            v.iter_mut().for_each(|x| *x /= size);
            (size, v)
        });
        let (size, v) = candidates.max_by(|a, b| a.0.total_cmp(&b.0))?;
        if size < FLAT {
            return None;
        }
        before.push((&motion.links, v));
    }
    before.pop().map(|(_, v)| v)
}
