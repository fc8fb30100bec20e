//! Where joints are drawn on their axes: those that meet in a point with axes of different directions stand apart.

use crate::draw::place::projection::{joint_frame, places_extent, places_middle, planar_normal};
use crate::draw::prelude::*;
use crate::geom::vector::{cross, length as norm};

/// Returns joints as they are shown. Those that meet in a point with axes of different directions are moved along them.
pub(crate) fn shown_places(mechanism: &Mechanism, joints: &[JointId]) -> Vec<JointInSpace> {
    let mut out: Vec<JointInSpace> = joints.iter().map(|&j| joint_frame(mechanism, j)).collect();
    if planar_normal(&out).is_some() {
        return out;
    }
    let crowd = CloseJoints {
        mechanism,
        joints,
        size: places_extent(&out),
        old: out.clone(),
    };
    for (i, place) in out.iter_mut().enumerate() {
        if let Some(point) = crowd.moved_point(i) {
            (place.point, place.moved) = (point, true);
        }
    }
    out
}

/// Joints where the coordinates have them, of which some meet in a point.
struct CloseJoints<'a> {
    mechanism: &'a Mechanism,
    joints: &'a [JointId],
    size: f64,
    old: Vec<JointInSpace>,
}

impl CloseJoints<'_> {
    /// Returns the place at which a joint is shown, or `None` if it is not moved.
    fn moved_point(&self, i: usize) -> Option<Vector> {
        let (old, size) = (&self.old, self.size);
        let near = |a: Vector, b: Vector| norm(sub(a, b)) <= 1e-6 * size;
        let group: Vec<usize> = (0..old.len())
            .filter(|&k| k != i && near(old[k].point, old[i].point))
            .collect();
        if group.is_empty() {
            return None;
        }
        let joint = &self.mechanism.joints[self.joints[i]];
        let (p, z) = (old[i].point, old[i].z);
        if matches!(joint.joint_type, JointType::Prismatic)
            && let Some(middle) = middle_between(self.mechanism, self.joints, old, i)
            && !near(middle, p)
        {
            return Some(middle);
        }
        let slides = joint
            .joint_type
            .freedoms()
            .iter()
            .all(|f| matches!(f, Freedom::Rz | Freedom::Tz | Freedom::Screw));
        let slanted = group.iter().any(|&k| norm(cross(old[k].z, z)) > 1e-6);
        if !slides || !slanted || joint.joint_type == JointType::Fixed {
            return None;
        }
        let twins = group
            .iter()
            .filter(|&&k| k < i && norm(cross(old[k].z, z)) <= 1e-6)
            .count();
        let t = self.free_of_others(i) * (1.0 + 0.5 * twins as f64);
        (t.abs() > 1e-6 * size).then(|| add(p, scale(z, t)))
    }

    /// Returns how far along its axis a joint is clear of the axes of others: between those that meet it, or outside.
    fn free_of_others(&self, i: usize) -> f64 {
        let (old, size) = (&self.old, self.size);
        let (p, z) = (old[i].point, old[i].z);
        let links = |i: usize| self.mechanism.joints[self.joints[i]].links;
        // where the axes of joints on the same links meet this one
        let mut meets: Vec<f64> = (0..old.len())
            .filter(|&k| k != i && links(k).iter().any(|l| links(i).contains(l)))
            .filter_map(|k| meeting_parameter(p, z, old[k].point, old[k].z, 1e-5 * size.max(1e-12)))
            .collect();
        meets.sort_by(f64::total_cmp);
        let (low, high) = match (meets.first(), meets.last()) {
            (Some(&a), Some(&b)) => (a, b),
            _ => (0.0, 0.0),
        };
        if high - low > 1e-5 * size {
            return (low + high) / 2.0;
        }
        let step = if size > 0.0 { 0.2 * size } else { 1.0 };
        let outward = dot(sub(add(p, scale(z, low)), places_middle(old)), z);
        low + if outward < -1e-9 * size { -step } else { step }
    }
}

/// Returns the middle between the other joints of the two bars that a sliding pair joins.
fn middle_between(
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

/// Returns where on the line p + t·z the line q + s·w meets it.
pub(crate) fn meeting_parameter(
    p: Vector,
    z: Vector,
    q: Vector,
    w: Vector,
    near: f64,
) -> Option<f64> {
    let n = cross(z, w);
    let nn = dot(n, n);
    if nn < 1e-12 {
        return None;
    }
    let apart = sub(q, p);
    let gap = dot(apart, n).abs() / nn.sqrt();
    (gap <= near).then(|| dot(cross(apart, w), n) / nn)
}
