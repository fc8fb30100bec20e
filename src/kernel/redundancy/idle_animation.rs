//! An idle freedom as a motion to be seen: to and fro by a little, along the motion that the analysis lists.
//!
//! The analysis knows idle motions modulo a prime, where numbers have no size; here the same motions are found among the
//! null vectors of J by the links that rest in them, and closed by Newton's method where a real motion follows them.

use crate::closure::tree::path_from_frame;
use crate::geom::exact::ExactError;
use crate::geom::rigid::RigidMotion;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::motion::drive_range::Way;
use crate::motion::pose::{FLAT, Pose};
use crate::redundancy::local_mobility::Idle;
use ozols_dense::svd;
use std::f64::consts::TAU;

/// The largest coordinate of a wiggle: radians, or fractions of [`Pose::length`].
pub const FAR: f64 = 0.35;
/// Poses of a wiggle.
const STEPS: usize = 48;
/// A closed pose farther from where first order leads than this share of the way is another motion.
const ASTRAY: f64 = 0.5;

/// An idle freedom as a motion.
#[derive(Debug, Clone)]
pub struct Wiggle {
    /// The poses, once to and fro.
    pub way: Way,
    /// Whether every pose closes; else they follow the motion to first order, and parts come apart by the second.
    pub closed: bool,
}

/// One of the idle motions of a state; `None` where the numbers do not show it.
///
/// # Errors
/// Where a coordinate has no value.
///
/// # Complexity
/// Singular values of a matrix of six rows a contour and a link that rests, for each motion up to the one asked for; then a
/// closing a pose.
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
    let largest = speeds.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    // links that rest in it do so all the way
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
        let size = |q: &[f64]| q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let found = pose.close(ahead.clone(), &held).ok().filter(|q| {
            let off: Vec<f64> = q.iter().zip(&ahead).map(|(a, b)| a - b).collect();
            size(&off) <= ASTRAY * size(&ahead)
        });
        closed &= found.is_some();
        let mut there = pose.moved(&found.unwrap_or(ahead)).links;
        // they hang on links that move, by what closing leaves open
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

/// The speeds of one of the motions: the null vectors under which the same links rest, less the motions before it of some of
/// these links.
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
            let mut v: Vec<f64> = (0..null.nrows()).map(|r| null[(r, c)]).collect();
            for (_, other) in before.iter().filter(|(links, _)| within(links)) {
                let along: f64 = v.iter().zip(other).map(|(a, b)| a * b).sum();
                v.iter_mut().zip(other).for_each(|(a, b)| *a -= along * b);
            }
            let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
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
