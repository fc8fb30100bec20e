//! Lines that are nearly coaxial or concurrent, and centres of joints near their crossings.

use super::relation::Relation;
use crate::geom::exact_vector::{ExactVector, add_scaled, cross, foot, is_zero, sub};
use crate::geom::expr::Expr;
use crate::geom::vector::{self, Vector, dot, length, real, unit};
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, Mechanism};
use std::cmp::Reverse;

/// Minimum sine between two lines that are made to meet. Below it, the position of the crossing is too uncertain.
const SKEW: f64 = 1e-2;

/// Gaps caused by rounding of doubles.
const DOUBLE: f64 = 1e-13;

/// The relevant part of a joint's position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlaceKind {
    /// None: the joint only slides.
    Nowhere,
    /// The line of its axis.
    Line,
    /// Its point.
    Centre,
}

/// Returns the relevant part of the position of a joint type.
pub(super) fn kind(joint_type: &JointType) -> PlaceKind {
    let turns = |f: &&Freedom| f.turns() || **f == Freedom::Screw;
    let turning: Vec<&Freedom> = joint_type.freedoms().iter().filter(turns).collect();
    match turning[..] {
        [] => PlaceKind::Nowhere,
        [Freedom::Rz | Freedom::Screw] => PlaceKind::Line,
        _ => PlaceKind::Centre,
    }
}

/// Joints on one line, or with one centre.
struct AlignedJoints {
    /// The joints; the first is the reference for the others.
    joints: Vec<JointId>,
    point: ExactVector,
    /// Direction of the line, or `None` for a centre.
    along: Option<ExactVector>,
    /// Whether it must stay, because it passes through a point that others share.
    fixed: bool,
}

impl AlignedJoints {
    fn distance(&self, p: Vector) -> f64 {
        let off = vector::sub(p, real(&self.point));
        match &self.along {
            Some(a) => length(vector::cross(off, unit(real(a)))),
            None => length(off),
        }
    }

    /// Returns its point nearest to `p`.
    fn nearest(&self, p: &ExactVector) -> Option<ExactVector> {
        match &self.along {
            Some(a) => foot(p, &self.point, a),
            None => Some(self.point.clone()),
        }
    }

    fn passes(&self, p: &ExactVector) -> bool {
        let off = sub(p, &self.point);
        is_zero(&match &self.along {
            Some(a) => cross(&off, a),
            None => off,
        })
    }
}

/// New position of a joint's point, and the reason.
pub(super) struct Put {
    pub(super) joint: JointId,
    pub(super) point: ExactVector,
    pub(super) relations: Vec<(Relation, Option<JointId>)>,
}

/// Moves lines and centres that are within `near` of each other to exact coincidence, each point perpendicular to its
/// line.
pub(super) fn places(m: &Mechanism, near: f64) -> Vec<Put> {
    let mut of = gather(m, near);
    let mut met: Vec<(JointId, JointId)> = Vec::new();
    let mut ranked: Vec<(usize, ExactVector)> = candidates(&of, near)
        .into_iter()
        .map(|x| (through(&of, real(&x), near).len(), x))
        .filter(|(n, _)| *n > 1)
        .collect();
    ranked.sort_by_key(|(n, _)| Reverse(*n));
    for (_, x) in ranked {
        meet(&mut of, &x, near, &mut met);
    }
    let mut out = Vec::new();
    for place in &of {
        for &joint in &place.joints {
            let before = &m.joints[joint].frame.point;
            let Some(point) = place.nearest(before) else {
                continue;
            };
            let mut relations = Vec::new();
            if let Some(&first) = place.joints.first().filter(|f| **f != joint) {
                relations.push(match place.along {
                    Some(_) => (Relation::Coaxial, Some(first)),
                    None => (Relation::Concentric, Some(first)),
                });
            }
            let with = met.iter().find(|(a, _)| *a == place.joints[0]);
            relations.extend(with.map(|(_, b)| (Relation::Meeting, Some(*b))));
            out.push(Put {
                joint,
                point,
                relations,
            });
        }
    }
    out
}

/// Collects lines and centres, with coincident ones merged.
fn gather(m: &Mechanism, near: f64) -> Vec<AlignedJoints> {
    let mut of: Vec<AlignedJoints> = Vec::new();
    for (j, joint) in m.joints_with_ids() {
        let along = match kind(&joint.joint_type) {
            PlaceKind::Nowhere => continue,
            PlaceKind::Line => Some(&joint.frame.axis),
            PlaceKind::Centre => None,
        };
        let point = &joint.frame.point;
        let at = real(point);
        // Doubles come first, because exact products take a hundred times as long.
        let same = |p: &&mut AlignedJoints| {
            p.distance(at) <= near
                && match (&p.along, along) {
                    (Some(a), Some(b)) => is_zero(&cross(a, b)),
                    (None, None) => true,
                    _ => false,
                }
        };
        match of.iter_mut().find(same) {
            Some(p) => p.joints.push(j),
            None => of.push(AlignedJoints {
                joints: vec![j],
                point: point.clone(),
                along: along.cloned(),
                fixed: false,
            }),
        }
    }
    of
}

/// Returns the centres, and the near crossings of lines.
fn candidates(of: &[AlignedJoints], near: f64) -> Vec<ExactVector> {
    let mut out: Vec<ExactVector> = Vec::new();
    out.extend(
        of.iter()
            .filter(|p| p.along.is_none())
            .map(|p| p.point.clone()),
    );
    for (n, a) in of.iter().enumerate() {
        for b in &of[..n] {
            out.extend(crossing(a, b, near));
        }
    }
    out
}

/// Returns the point of line `a` that is nearest to line `b`, to double precision, if the two nearly meet.
fn crossing(a: &AlignedJoints, b: &AlignedJoints, near: f64) -> Option<ExactVector> {
    let (along, other) = (a.along.as_ref()?, b.along.as_ref()?);
    let (u, w) = (real(along), unit(real(other)));
    let normal = vector::cross(u, w);
    let square = dot(normal, normal);
    let off = vector::sub(real(&b.point), real(&a.point));
    if square.sqrt() < SKEW * length(u) || dot(off, normal).abs() > near * square.sqrt() {
        return None;
    }
    // Roots that meet to double precision do meet; no decimal could give the position.
    let rational = [&a.point, &b.point, along, other]
        .into_iter()
        .flatten()
        .all(|x| x.rational_ref().is_some());
    if !rational && dot(off, normal).abs() <= DOUBLE * length(off) * square.sqrt() {
        return None;
    }
    let t = dot(vector::cross(off, w), normal) / square;
    Some(add_scaled(&a.point, &Expr::from_f64(t).ok()?, along))
}

fn through(of: &[AlignedJoints], p: Vector, near: f64) -> Vec<usize> {
    let near = |i: &usize| of[*i].distance(p) <= near;
    (0..of.len()).filter(near).collect()
}

/// Moves everything near a point there. Fixed elements determine its position.
fn meet(of: &mut [AlignedJoints], x: &ExactVector, near: f64, met: &mut Vec<(JointId, JointId)>) {
    let mut here = through(of, real(x), near);
    // Sorted as fixed centres, then fixed lines, then the others.
    here.sort_by_key(|&i| (!of[i].fixed, of[i].along.is_some()));
    let Some((&first, rest)) = here.split_first().filter(|(_, rest)| !rest.is_empty()) else {
        return;
    };
    let point = if of[first].fixed {
        let Some(point) = of[first].nearest(x) else {
            return;
        };
        point
    } else {
        x.clone()
    };
    for &i in &here {
        if of[i].passes(&point) {
            of[i].fixed = true;
        } else if !of[i].fixed {
            of[i].point.clone_from(&point);
            of[i].fixed = true;
        }
    }
    let lead = of[first].joints[0];
    for &i in rest {
        if of[i].passes(&point) {
            met.push((of[i].joints[0], lead));
            met.push((lead, of[i].joints[0]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(point: [f64; 3], along: [f64; 3]) -> AlignedJoints {
        let exact = |v: [f64; 3]| v.map(|x| Expr::from_f64(x).unwrap());
        AlignedJoints {
            joints: Vec::new(),
            point: exact(point),
            along: Some(exact(along)),
            fixed: false,
        }
    }

    /// Two lines, one `apart` above the other, have that distance for any angle between them.
    #[test]
    fn lines_cross_by_their_distance_whatever_their_angle() {
        let near = 1e-3;
        for across in [0.02, 0.3, 1.0, 40.0] {
            for (apart, meet) in [(0.5 * near, true), (1.5 * near, false), (9.0 * near, false)] {
                let a = line([0.0; 3], [1.0, 0.0, 0.0]);
                let b = line([0.0, 0.0, apart], [1.0, across, 0.0]);
                assert_eq!(crossing(&a, &b, near).is_some(), meet, "{across} {apart}");
            }
        }
    }
}
