//! Jaws that close on each other: the position in a range at which their faces meet. Beyond it they would pass through
//! each other.

use crate::geom::expr::Expr;
use crate::geom::vector::{Vector, add, dot, length, scale, sub};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::motion::drive_range::Way;
use crate::motion::pose::Pose;
use std::f64::consts::TAU;

/// Share of the initial distance above which faces that pass each other have not met.
const NEAR: f64 = 0.2;

/// Returns the joints at which output links are to hold an object that is absent in a state, with those links.
pub fn jaw_faces(m: &Mechanism, state: StateId) -> impl Iterator<Item = (JointId, LinkId)> {
    let role = |l: LinkId| m.links[l].role;
    m.joint_ids().filter_map(move |j| {
        let joint = &m.joints[j];
        let elsewhere = joint.states.as_ref().is_some_and(|s| !s.contains(&state));
        let [a, b] = joint.links;
        let jaw = match [role(a), role(b)] {
            [Role::Output, Role::Object] => a,
            [Role::Object, Role::Output] => b,
            _ => return None,
        };
        elsewhere.then_some((j, jaw))
    })
}

/// Returns the positions at which the drive has closed the jaws, before the pose of the file and after it. Each is
/// `None` if the jaws do not close.
#[must_use]
pub fn jaws_meet(m: &Mechanism, state: StateId, pose: &Pose, way: &Way) -> [Option<f64>; 2] {
    let real = |v: &[Expr; 3]| v.each_ref().map(Expr::to_f64);
    let own = m.points.iter().map(|p| (p.link, real(&p.point)));
    let own = own.filter(|(l, _)| m.links[*l].role == Role::Output);
    let held = jaw_faces(m, state).map(|(j, jaw)| (jaw, real(&m.joints[j].frame.point)));
    let points: Vec<(LinkId, Vector)> = own.chain(held).collect();
    let mut met = [None, None];
    for (n, a) in points.iter().enumerate() {
        for b in points[..n].iter().filter(|b| b.0 != a.0) {
            let gap = |k: usize| {
                let at = |(link, p): &(LinkId, Vector)| pose.carry_point(&way.links[k], *link, *p);
                sub(at(a), at(b))
            };
            let sides =
                [poses_backwards(way), poses_onwards(way)].map(|steps| gap_crossing(&steps, gap));
            for (n, found) in sides.into_iter().enumerate() {
                let nearer = |old: f64| found.is_none_or(|new| new.abs() > old.abs());
                if !met[n].is_some_and(nearer) {
                    met[n] = found;
                }
            }
        }
    }
    met
}

/// Returns the poses from that of the file onwards, each with the position of the drive.
fn poses_onwards(way: &Way) -> Vec<(usize, f64)> {
    (way.start..way.at.len()).map(|k| (k, way.at[k])).collect()
}

/// Returns the poses from that of the file backwards, wrapping around from the end if the drive rotates fully.
fn poses_backwards(way: &Way) -> Vec<(usize, f64)> {
    let own = (0..=way.start).rev().map(|k| (k, way.at[k]));
    let round = (way.start + 1..way.at.len()).rev();
    let round = round.map(|k| (k, way.at[k] - TAU));
    own.chain(round.filter(|_| way.closed)).collect()
}

/// Returns the position of the drive at which a gap vanishes and would change its direction.
fn gap_crossing(steps: &[(usize, f64)], gap: impl Fn(usize) -> Vector) -> Option<f64> {
    let first = gap(steps.first()?.0);
    let open = length(first);
    steps.windows(2).find_map(|pair| {
        let [(k, from), (l, to)] = [pair[0], pair[1]];
        let [before, after] = [gap(k), gap(l)];
        let [along, beyond] = [before, after].map(|g| dot(g, first));
        if !(along > 0.0 && beyond <= 0.0) {
            return None;
        }
        let part = along / (along - beyond);
        let nearest = length(add(before, scale(sub(after, before), part)));
        (nearest <= NEAR * open).then_some(from + part * (to - from))
    })
}
