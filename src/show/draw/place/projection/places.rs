//! Where joints are drawn on their axes: those that meet in a point with axes of different directions stand apart.

use super::{JointInSpace, extent, frame, middle, planar};
use crate::geom::vector::{Vector, add, cross, dot, length as norm, scale, sub};
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, Mechanism};

/// Joints as they are shown: those that meet in a point with axes of different directions are moved along them.
pub(crate) fn places(mechanism: &Mechanism, joints: &[JointId]) -> Vec<JointInSpace> {
    let mut out: Vec<JointInSpace> = joints.iter().map(|&j| frame(mechanism, j)).collect();
    if planar(&out).is_some() {
        return out;
    }
    let size = extent(&out);
    let near = |a: Vector, b: Vector| norm(sub(a, b)) <= 1e-6 * size;
    let step = if size > 0.0 { 0.2 * size } else { 1.0 };
    let old = out.clone();
    let links = |i: usize| mechanism.joints[joints[i]].links;
    for i in 0..out.len() {
        let group: Vec<usize> = (0..old.len())
            .filter(|&k| k != i && near(old[k].point, old[i].point))
            .collect();
        if group.is_empty() {
            continue;
        }
        let joint = &mechanism.joints[joints[i]];
        let (p, z) = (old[i].point, old[i].z);
        if matches!(joint.joint_type, JointType::Prismatic)
            && let Some(middle) = between(mechanism, joints, &old, i)
            && !near(middle, p)
        {
            (out[i].point, out[i].moved) = (middle, true);
            continue;
        }
        let slides = joint
            .joint_type
            .freedoms()
            .iter()
            .all(|f| matches!(f, Freedom::Rz | Freedom::Tz | Freedom::Screw));
        let slanted = group.iter().any(|&k| norm(cross(old[k].z, z)) > 1e-6);
        if !slides || !slanted || joint.joint_type == JointType::Fixed {
            continue;
        }
        // where the axes of joints on the same links meet this one
        let mut meets: Vec<f64> = (0..old.len())
            .filter(|&k| k != i && links(k).iter().any(|l| links(i).contains(l)))
            .filter_map(|k| meet(p, z, old[k].point, old[k].z, 1e-5 * size.max(1e-12)))
            .collect();
        meets.sort_by(f64::total_cmp);
        let (low, high) = match (meets.first(), meets.last()) {
            (Some(&a), Some(&b)) => (a, b),
            _ => (0.0, 0.0),
        };
        let t = if high - low > 1e-5 * size {
            (low + high) / 2.0
        } else {
            let middle = middle(&old);
            let outward = dot(sub(add(p, scale(z, low)), middle), z);
            low + if outward < -1e-9 * size { -step } else { step }
        };
        let twins = group
            .iter()
            .filter(|&&k| k < i && norm(cross(old[k].z, z)) <= 1e-6)
            .count();
        let t = t * (1.0 + 0.5 * twins as f64);
        if t.abs() > 1e-6 * size {
            (out[i].point, out[i].moved) = (add(p, scale(z, t)), true);
        }
    }
    out
}

/// The middle between the other joints of the two bars that a sliding pair joins.
fn between(
    mechanism: &Mechanism,
    joints: &[JointId],
    at: &[JointInSpace],
    i: usize,
) -> Option<Vector> {
    let ends = mechanism.joints[joints[i]].links.map(|l| {
        let mut others =
            (0..joints.len()).filter(|&k| k != i && mechanism.joints[joints[k]].links.contains(&l));
        let one = others.next();
        one.filter(|_| others.next().is_none())
    });
    let (a, b) = (at[ends[0]?].point, at[ends[1]?].point);
    Some(scale(add(a, b), 0.5))
}

/// Where on the line p + t·z the line q + s·w meets it.
fn meet(p: Vector, z: Vector, q: Vector, w: Vector, near: f64) -> Option<f64> {
    let n = cross(z, w);
    let nn = dot(n, n);
    if nn < 1e-12 {
        return None;
    }
    let apart = sub(q, p);
    let gap = dot(apart, n).abs() / nn.sqrt();
    (gap <= near).then(|| dot(cross(apart, w), n) / nn)
}
