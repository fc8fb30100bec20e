//! Joints that are nearly special: axes that are almost parallel, perpendicular, coaxial or concurrent, with the
//! relation and the deviation from it.

mod directions;
mod places;
pub mod relation;

use crate::geom::exact_vector::{self, across, is_zero};
use crate::geom::expr::Expr;
use crate::geom::vector::{self, Vector, length, real, sub, unit};
use crate::model::mechanism::{Frame, Joint, JointId, Mechanism, Mode};
use crate::model::rounded::looks_rounded;
use crate::rank::rounded::size;
use crate::rank::rounded::verdict::allowed;
use directions::Directions;
use places::{PlaceKind, kind, places};
use relation::{NearJoint, Reach, Relation};

/// Returns how far the rounding of coordinates can have moved two joints of a mechanism apart, or `None` if its digits
/// are exact.
#[must_use]
pub fn reach(mechanism: &Mechanism) -> Option<Reach> {
    let half = allowed(mechanism, looks_rounded(mechanism).as_ref())?;
    let [length, direction] = half.largest(mechanism).map(|h| 2.0 * h);
    let size = size(mechanism);
    Some(Reach {
        length: 2.0 * (length + size * direction),
        angle: 2.0 * direction.max(length / size),
    })
}

/// Returns the joints that are nearly special, in file order. Their directions are within the angle of each other or of
/// a right angle. Their lines and centres are within the length of a common point or of each other.
///
/// # Guarantee
/// No deviation exceeds the reach.
///
/// # Complexity
/// O(p³) in the number of joints p.
#[must_use]
pub fn nearly_special(mechanism: &Mechanism, reach: Reach) -> Vec<NearJoint> {
    let mut out = mechanism.clone();
    let mut why: Vec<Vec<(Relation, Option<JointId>)>> = vec![Vec::new(); out.joints.len()];
    for (joint, why) in out.joints.iter_mut().zip(&mut why) {
        for x in &mut joint.frame.point {
            if !x.is_zero_rational() && x.to_f64().abs() <= reach.length / 4.0 {
                *x = Expr::from(0);
                why.push((Relation::Zero, None));
            }
        }
    }
    turn(&mut out, reach.angle, &mut why);
    for put in places(&out, reach.length) {
        out.joints[put.joint].frame.point = put.point;
        why[put.joint.index()].extend(put.relations);
    }
    let pairs = mechanism.joints.iter().zip(&out.joints);
    let all = mechanism.joint_ids().zip(pairs).zip(why);
    all.filter(|((_, (written, special)), _)| !same(&special.frame, &written.frame))
        .map(|((joint, (written, special)), relations)| NearJoint {
            joint,
            shift: shift(written, special),
            turn: turned(written, special),
            relations,
        })
        .filter(|x| {
            // Allowance for the rounding of doubles.
            let much = 1.0 + 1e-9;
            x.shift <= much * reach.length && x.turn <= much * reach.angle
        })
        .collect()
}

/// Snaps axes and second axes.
fn turn(m: &mut Mechanism, angle: f64, why: &mut [Vec<(Relation, Option<JointId>)>]) {
    let normal = match &m.mode {
        Mode::Spatial => None,
        Mode::Planar { normal } => Some(normal),
    };
    let mut directions = Directions::new(angle, normal);
    let ids = m.joint_ids();
    for j in ids.clone() {
        let joint = &mut m.joints[j];
        if !joint.joint_type.is_directed() {
            continue;
        }
        if let Some((axis, how, of)) = directions.place(&joint.frame.axis, j) {
            joint.frame.axis = axis;
            why[j.index()].push((how, of));
        }
    }
    for j in ids {
        let joint = &mut m.joints[j];
        if !joint.joint_type.has_second_axis() {
            continue;
        }
        let x = across(&joint.frame.reference, &joint.frame.axis);
        if let Some((x, how, of)) = directions.place(&x, j) {
            joint.frame.reference = x;
            why[j.index()].push((how, of));
        }
    }
}

/// Returns the distance of a joint's line or centre from its special position.
fn shift(written: &Joint, special: &Joint) -> f64 {
    let off = sub(real(&special.frame.point), real(&written.frame.point));
    match kind(&written.joint_type) {
        PlaceKind::Nowhere => 0.0,
        PlaceKind::Line | PlaceKind::Centre => length(off),
    }
}

/// Returns the angle of a joint's axes from their special directions.
fn turned(written: &Joint, special: &Joint) -> f64 {
    let angle = |a: Vector, b: Vector| {
        let sine = length(vector::cross(unit(a), unit(b)));
        sine.min(1.0).asin()
    };
    let (a, b) = (&written.frame, &special.frame);
    let axis = angle(real(&a.axis), real(&b.axis));
    if !written.joint_type.has_second_axis() {
        return axis;
    }
    let x = |f: &Frame| real(&across(&f.reference, &f.axis));
    axis.max(angle(x(a), x(b)))
}

fn same(a: &Frame, b: &Frame) -> bool {
    let off = |x: &[Expr; 3], y: &[Expr; 3]| is_zero(&exact_vector::sub(x, y));
    off(&a.point, &b.point) && off(&a.axis, &b.axis) && off(&a.reference, &b.reference)
}
