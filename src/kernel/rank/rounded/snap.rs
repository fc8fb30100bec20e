//! Snapping rounded geometry: axes that are parallel, square, coaxial or concurrent but for the last digits are made so
//! exactly, none moved further than those digits allow, and everything moved is listed. Coordinates that were rational stay
//! so, and exact arithmetic applies afterwards.

mod directions;
mod places;
pub mod relation;

use crate::geom::exact_vector::{self, across, is_zero};
use crate::geom::expr::Expr;
use crate::geom::extent::Extent;
use crate::geom::vector::{self, Vector, length, real, sub, unit};
use crate::model::mechanism::{Frame, Joint, JointId, Mechanism, Mode};
use directions::Directions;
use places::{PlaceKind, kind, places};
use relation::{Moved, Reach, Relation};

/// A mechanism with its near-coincidences made exact.
#[derive(Debug, Clone)]
pub struct Snapped {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What was moved, joint by joint in file order.
    pub moved: Vec<Moved>,
    /// What would have had to move further, and stays as written.
    pub refused: Vec<Moved>,
}

/// The size of a mechanism that relative tolerances are of: half the diagonal of the box round its joints, or their distance
/// from the origin where they are one point.
#[must_use]
pub fn size(mechanism: &Mechanism) -> f64 {
    let points: Vec<Vector> = mechanism
        .joints
        .iter()
        .map(|j| real(&j.frame.point))
        .collect();
    Extent::of(&points).length
}

/// Makes near-coincidences exact: directions within the angle of each other or of square, lines and centres within the
/// length of a common point or of each other.
///
/// # Guarantee
/// No point, line or axis moves further than the reach; what would have to is refused and stays.
///
/// # Complexity
/// O(p³) in the number of joints p.
#[must_use]
pub fn snap(mechanism: &Mechanism, reach: Reach) -> Snapped {
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
    let (mut moved, mut refused) = (Vec::new(), Vec::new());
    for ((j, joint), (before, relations)) in mechanism
        .joint_ids()
        .zip(&mut out.joints)
        .zip(mechanism.joints.iter().zip(why))
    {
        if same(&joint.frame, &before.frame) {
            continue;
        }
        let one = Moved {
            joint: j,
            shift: shift(before, joint),
            turn: turned(before, joint),
            relations,
        };
        // Rounding of doubles aside.
        let much = 1.0 + 1e-9;
        if one.shift > much * reach.length || one.turn > much * reach.angle {
            joint.frame.clone_from(&before.frame);
            refused.push(one);
        } else {
            follow(joint, before);
            moved.push(one);
        }
    }
    Snapped {
        mechanism: out,
        moved,
        refused,
    }
}

/// Axes and second axes.
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

/// How far a joint's line or centre has gone.
fn shift(before: &Joint, after: &Joint) -> f64 {
    let off = sub(real(&after.frame.point), real(&before.frame.point));
    match kind(&before.joint_type) {
        PlaceKind::Nowhere => 0.0,
        PlaceKind::Line | PlaceKind::Centre => length(off),
    }
}

/// How far a joint's axes have turned.
fn turned(before: &Joint, after: &Joint) -> f64 {
    let angle = |a: Vector, b: Vector| {
        let sine = length(vector::cross(unit(a), unit(b)));
        sine.min(1.0).asin()
    };
    let (a, b) = (&before.frame, &after.frame);
    let axis = angle(real(&a.axis), real(&b.axis));
    if !before.joint_type.has_second_axis() {
        return axis;
    }
    let x = |f: &Frame| real(&across(&f.reference, &f.axis));
    axis.max(angle(x(a), x(b)))
}

/// Options that shared the joint's frame share it still.
fn follow(joint: &mut Joint, before: &Joint) {
    for option in joint.options.iter_mut().chain(&mut joint.unloading) {
        if same(&option.frame, &before.frame) {
            let pitch = option.frame.pitch.clone();
            option.frame = Frame {
                pitch,
                ..joint.frame.clone()
            };
        }
    }
}

fn same(a: &Frame, b: &Frame) -> bool {
    let off = |x: &[Expr; 3], y: &[Expr; 3]| is_zero(&exact_vector::sub(x, y));
    off(&a.point, &b.point) && off(&a.axis, &b.axis) && off(&a.reference, &b.reference)
}
