//! Description of a recovered scene: its relations in a sentence, and the joints it has moved.

use crate::geom::vector::{cross, dot, length, real, sub, unit};
use crate::meant::mechanism::Meant;
use crate::meant::relations::RelationKind;
use crate::model::mechanism::{Frame, Joint, JointId};

/// Returns the joints that a scene has moved, in file order.
#[must_use]
pub fn moved_joints(meant: &Meant) -> Vec<JointId> {
    let moved = |(j, joint): &(JointId, &Joint)| {
        let before = &meant.written[j.index()];
        let shift = length(sub(real(&joint.frame.point), real(&before.point)));
        shift != 0.0 || turned(before, &joint.frame) != 0.0
    };
    let joints = meant.mechanism.joints_with_ids();
    joints.filter(moved).map(|(j, _)| j).collect()
}

/// Returns the angle by which the axes of a frame have turned `[rad]`.
fn turned(before: &Frame, now: &Frame) -> f64 {
    let angle = |a: [f64; 3], b: [f64; 3]| {
        let (a, b) = (unit(a), unit(b));
        length(cross(a, b)).atan2(dot(a, b).abs())
    };
    // Differences at the level of rounding errors are not reported.
    let told = |x: f64| if x > 1e-15 { x } else { 0.0 };
    let of = |a: &[_; 3], b: &[_; 3]| told(angle(real(a), real(b)));
    of(&before.axis, &now.axis).max(of(&before.reference, &now.reference))
}

/// Describes the recovered relations: "13 axes parallel, 14 centres in planes, 4 equal vectors" and a largest move such
/// as 0.9 halves of a unit of the last digit.
#[must_use]
pub fn understood(meant: &Meant) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut groups: Vec<usize> = Vec::new();
    for (of, &cluster) in meant.rays.iter().zip(&meant.scene.cluster) {
        groups.resize(groups.len().max(cluster + 1), 0);
        groups[cluster] += usize::from(of.is_some());
    }
    groups.retain(|n| *n > 1);
    groups.sort_unstable_by(|a, b| b.cmp(a));
    if !groups.is_empty() {
        let all: Vec<String> = groups.iter().map(usize::to_string).collect();
        parts.push(format!("{} axes parallel", all.join(" + ")));
    }
    for (kind, what) in [
        (RelationKind::Coincident, "coincident centres"),
        (RelationKind::InPlane, "in a plane with another"),
        (RelationKind::OnLine, "on a line with another"),
        (RelationKind::EqualVectors, "equal vectors"),
        (RelationKind::Mirrored, "mirrored"),
    ] {
        let n = meant.scene.relations.iter().filter(|r| r.0 == kind).count();
        if n > 0 {
            parts.push(format!("{n} {what}"));
        }
    }
    if parts.is_empty() {
        parts.push("no two joints related".to_owned());
    }
    format!(
        "{}; every number moved by at most {:.2} units of its last digit",
        parts.join(", "),
        meant.scene.moved / 2.0
    )
}
