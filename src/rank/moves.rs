//! What a scene that is meant has moved, joint by joint.

use crate::geom::vector::{cross, dot, length, real, sub, unit};
use crate::meant::mechanism::Meant;
use crate::meant::relations::Kind;
use crate::model::mechanism::{Frame, JointId};
use crate::rank::snap::relation::{Moved, Relation};

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
                Kind::Coincident => Relation::Concentric,
                Kind::InPlane | Kind::Mirrored => Relation::InPlane,
                Kind::OnLine => Relation::Coaxial,
                Kind::EqualVectors => Relation::EqualVectors,
            },
            with,
        );
    }
    out
}
