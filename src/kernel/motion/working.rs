//! The working motion if no joint is a drive: along the null vector of J that moves the outputs most.

use crate::closure::tree::path_from_frame;
use crate::model::mechanism::{JointId, Mechanism, Role, StateId};
use crate::motion::drive_range::Way;
use crate::motion::pose::{FLAT, Pose};
use ozols_dense::{difference, dot, largest_entry, svd};

/// Distance to which it is followed to either side, by the coordinate that moves most from step to step: radians, or
/// fractions of [`Pose::length`].
pub(crate) const FAR: f64 = 0.9;
/// Share of a step beyond which a closed pose is too far from the first-order prediction and belongs to another motion.
const ASTRAY: f64 = 0.5;

/// Follows the working motion from a pose to either side in `steps` steps of equal length, as far as poses close.
/// Returns `None` if the motion of the outputs is only instantaneous.
///
/// # Complexity
/// Two decompositions of J and one closure per step.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, motion::{pose::Pose, working::working_way}};
/// let bennett = ozols::built_in("bennett")?;
/// let pose = Pose::of_file(&bennett, StateId::FREE)?;
/// assert!(working_way(&bennett, StateId::FREE, &pose, 10).is_some_and(|way| way.links.len() == 11));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn working_way(m: &Mechanism, state: StateId, pose: &Pose, steps: usize) -> Option<Way> {
    let outputs = m.link_ids().filter(|&l| m.links[l].role == Role::Output);
    let paths = outputs.map(|l| path_from_frame(m, state, l));
    let paths: Vec<Vec<(JointId, bool)>> = paths.filter(|p| !p.is_empty()).collect();
    let half = (steps / 2).max(1);
    let first = working_direction(pose, &paths, None)?;
    let side = |sign: f64| {
        let mut out = Vec::new();
        let mut at = pose.clone();
        let mut onward: Vec<f64> = first.iter().map(|x| sign * x).collect();
        for _ in 0..half {
            let Some((there, along)) = next(&at, &paths, &onward, FAR / half as f64) else {
                break;
            };
            out.push(there.links.clone());
            (at, onward) = (there, along);
        }
        out
    };
    let (mut before, after) = (side(-1.0), side(1.0));
    let start = before.len();
    let far = |i: usize| (i as f64 - start as f64) * FAR / half as f64;
    before.reverse();
    let links: Vec<_> = before
        .into_iter()
        .chain([pose.links.clone()])
        .chain(after)
        .collect();
    (links.len() > 1).then(|| Way {
        at: (0..links.len()).map(far).collect(),
        links,
        start,
        closed: false,
        ends: [None, None],
    })
}

/// Returns the next pose, one step on, and the direction of the step.
fn next(
    at: &Pose,
    paths: &[Vec<(JointId, bool)>],
    onward: &[f64],
    step: f64,
) -> Option<(Pose, Vec<f64>)> {
    let along = working_direction(at, paths, Some(onward))?;
    let ahead: Vec<f64> = along.iter().map(|x| step * x).collect();
    let q = at.close_loops(ahead.clone(), &[]).ok()?;
    (largest_entry(&difference(&q, &ahead)) <= ASTRAY * step).then(|| (at.moved_to(&q), q))
}

/// Returns the motion, scaled to a largest coordinate of 1, that moves the outputs most for its size. During following
/// it is the one nearest to the incoming direction. Idle freedoms take no part.
fn working_direction(
    pose: &Pose,
    paths: &[Vec<(JointId, bool)>],
    onward: Option<&[f64]>,
) -> Option<Vec<f64>> {
    let f = pose.columns.len();
    let all = pose.jacobian_with(paths, &[]);
    let closure = svd(&pose.jacobian_at(&vec![0.0; f]))?;
    let kernel = closure.null_space(closure.rank(FLAT));
    let rows: Vec<usize> = (pose.rows()..all.nrows()).collect();
    let moved = svd(&all.select_rows(&rows).times(&kernel))?;
    let working = moved.values.iter().filter(|&&s| s > FLAT).count();
    let mut out = vec![0.0; f];
    for i in 0..working.min(if onward.is_some() { working } else { 1 }) {
        let own = kernel.combine_columns(moved.v.col(i));
        let share = onward.map_or(1.0, |o| dot(o, &own));
        out.iter_mut().zip(&own).for_each(|(x, y)| *x += share * y);
    }
    let size = largest_entry(&out);
    (size > FLAT).then(|| out.into_iter().map(|x| x / size).collect())
}
