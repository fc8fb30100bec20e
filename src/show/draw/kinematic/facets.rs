//! Plates of folds as the facets that their creases bound.

use super::Kinematic;
use crate::draw::place::projection::{
    JointInSpace, Vector, add, cross, dot, norm, scale as times, sub,
};
use crate::model::joint_type::JointType;

/// Creases that pass each other by more than this share of a plate's size do not meet.
const MEET: f64 = 1e-4;
/// A corner farther from the middle of its crease than this many times the plate's size is not a corner of the plate.
const FARTHEST: f64 = 3.0;

impl Kinematic<'_> {
    /// Returns the corners of each plate of a fold, by row of the links. Empty for other mechanisms.
    ///
    /// A fold has a plate with three creases or more, and each of its links is a plate: its joints are hinges whose
    /// axes lie in a plane and meet. A ring about one vertex is a spherical linkage and is drawn as one.
    pub(super) fn facets_in_space(&self) -> Vec<Option<Vec<Vector>>> {
        let all: Vec<_> = (0..self.links.len())
            .map(|row| self.facet_in_space(row))
            .collect();
        let inner = self.links.iter().any(|(_, of)| of.len() > 2);
        if inner && all.iter().all(Option::is_some) {
            all
        } else {
            vec![None; self.links.len()]
        }
    }

    fn facet_in_space(&self, row: usize) -> Option<Vec<Vector>> {
        let (link, of) = &self.links[row];
        let hinge = |&i: &usize| {
            let joint = &self.subject.mechanism.joints[self.spots[i].joint];
            joint.joint_type == JointType::Revolute && !self.places[i].moved
        };
        if of.len() < 2 || !of.iter().all(hinge) || self.points_of(*link).next().is_some() {
            return None;
        }
        let creases: Vec<&JointInSpace> = of.iter().map(|&i| &self.places[i]).collect();
        let apart = |a: &JointInSpace, b: &JointInSpace| norm(sub(a.point, b.point));
        let pairs = creases
            .iter()
            .flat_map(|a| creases.iter().map(move |b| (a, b)));
        let size = pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max);
        let ends: Vec<Crease> = creases
            .iter()
            .map(|c| find_crease(c, &creases, size))
            .collect::<Option<_>>()?;
        let mut corners: Vec<Vector> = Vec::new();
        let ends = ends.iter().flat_map(|c| c.ends);
        for p in ends {
            if !corners.iter().any(|&q| norm(sub(p, q)) < 1e-3 * size) {
                corners.push(p);
            }
        }
        // Two creases meet in one corner: the one across makes the facet a parallelogram.
        if let (2, &[a, b, c]) = (creases.len(), corners.as_slice()) {
            let at = [a, b, c].map(|p| creases.iter().filter(|x| is_on_crease(x, p, size)).count());
            let shared = at.iter().position(|&n| n == 2)?;
            let sum = add(add(a, b), c);
            corners.push(sub(sum, times([a, b, c][shared], 2.0)));
        }
        (corners.len() > 3).then_some(corners)
    }
}

/// A crease from corner to corner.
struct Crease {
    ends: [Vector; 2],
}

/// Returns the ends of a crease: its intersections with the next creases of its plate. If one end has none, it is as
/// far as the other. Returns `None` if a crease passes it or none meets it nearby.
fn find_crease(own: &JointInSpace, all: &[&JointInSpace], size: f64) -> Option<Crease> {
    let mut reach = [f64::NEG_INFINITY, f64::INFINITY];
    for other in all {
        let n = cross(own.z, other.z);
        if dot(n, n) < 1e-9 {
            continue;
        }
        let apart = sub(other.point, own.point);
        if dot(apart, n).abs() > MEET * size * norm(n) {
            return None;
        }
        let t = dot(cross(apart, other.z), n) / dot(n, n);
        if t < 0.0 {
            reach[0] = reach[0].max(t);
        } else {
            reach[1] = reach[1].min(t);
        }
    }
    let [low, high] = match reach.map(f64::is_finite) {
        [true, true] => reach,
        [true, false] => [reach[0], -reach[0]],
        [false, true] => [-reach[1], reach[1]],
        [false, false] => return None,
    };
    let near = low.abs().max(high.abs()) <= FARTHEST * size && high - low > 1e-3 * size;
    let at = |t| add(own.point, times(own.z, t));
    near.then(|| Crease {
        ends: [at(low), at(high)],
    })
}

/// Returns true if a point is on a crease.
fn is_on_crease(crease: &JointInSpace, p: Vector, size: f64) -> bool {
    norm(cross(crease.z, sub(p, crease.point))) < 1e-3 * size
}
