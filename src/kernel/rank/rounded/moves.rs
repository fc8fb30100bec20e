//! What a scene that is meant has, in a sentence, and what it has moved, joint by joint.

use crate::geom::vector::{cross, dot, length, real, sub, unit};
use crate::meant::mechanism::Meant;
use crate::meant::relations::RelationKind;
use crate::model::mechanism::{Frame, JointId};
use crate::rank::rounded::snap::relation::{Moved, Relation};

/// The joints that a scene has moved, in file order, with what they are now.
#[must_use]
pub fn moves(meant: &Meant) -> Vec<Moved> {
    let mut out: Vec<Moved> = Vec::new();
    for (j, joint) in meant.mechanism.joints_with_ids() {
        let before = &meant.written[j.index()];
        let now = &joint.frame;
        let shift = length(sub(real(&now.point), real(&before.point)));
        let turn = turned(before, now);
        if shift == 0.0 && turn == 0.0 {
            continue;
        }
        out.push(Moved {
            joint: j,
            shift,
            turn,
            relations: relations(meant, j),
        });
    }
    out
}

/// How far the axes of a frame have turned `[rad]`.
fn turned(before: &Frame, now: &Frame) -> f64 {
    let angle = |a: [f64; 3], b: [f64; 3]| {
        let (a, b) = (unit(a), unit(b));
        length(cross(a, b)).atan2(dot(a, b).abs())
    };
    // Of doubles alone nothing is told.
    let told = |x: f64| if x > 1e-15 { x } else { 0.0 };
    let of = |a: &[_; 3], b: &[_; 3]| told(angle(real(a), real(b)));
    of(&before.axis, &now.axis).max(of(&before.reference, &now.reference))
}

/// What a joint is to others, each relation once, to the first that has it.
fn relations(meant: &Meant, j: JointId) -> Vec<(Relation, Option<JointId>)> {
    let mut out: Vec<(Relation, Option<JointId>)> = Vec::new();
    let mut add = |r: Relation, with: JointId| {
        if with != j && !out.iter().any(|(known, _)| *known == r) {
            out.push((r, Some(with)));
        }
    };
    let rays = meant.rays.iter().zip(&meant.scene.cluster);
    for (_, cluster) in rays.clone().filter(|(of, _)| **of == Some(j)) {
        let alike = rays
            .clone()
            .find(|(of, c)| *c == cluster && of.is_some_and(|of| of != j));
        if let Some(with) = alike.and_then(|(of, _)| *of) {
            add(Relation::Parallel, with);
        }
    }
    for (kind, points) in &meant.scene.relations {
        if !points.iter().any(|&p| meant.points[p] == j) {
            continue;
        }
        let Some(with) = points.iter().map(|&p| meant.points[p]).find(|of| *of != j) else {
            continue;
        };
        add(
            match kind {
                RelationKind::Coincident => Relation::Concentric,
                RelationKind::InPlane | RelationKind::Mirrored => Relation::InPlane,
                RelationKind::OnLine => Relation::Coaxial,
                RelationKind::EqualVectors => Relation::EqualVectors,
            },
            with,
        );
    }
    out
}

/// What was understood: "13 axes parallel, 14 centres in planes, 4 equal vectors; no number moved by more than 0.9 halves of a
/// unit of its last digit".
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
        (RelationKind::Coincident, "centres one with another"),
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
        "{}; no number moved by more than {:.2} units of its last digit",
        parts.join(", "),
        meant.scene.moved / 2.0
    )
}
