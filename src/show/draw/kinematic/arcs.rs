//! Links that are not straight bars: arcs about the common point of the axes in spherical linkages, and bars that bow
//! out to pass another.

use crate::draw::kinematic::Kinematic;
use crate::draw::place::projection::places::meeting_parameter;
use crate::draw::place::projection::{cross, norm, scale as times};
use crate::draw::prelude::*;
use crate::geom::vector::unit;

/// The pieces of an arc.
const PIECES: i32 = 16;
/// Axes that pass each other by more than this share of the distance from where they meet do not meet.
const MEET: f64 = 1e-4;

impl Kinematic<'_> {
    /// Returns the line of a bowed bar, in the plane of the paper.
    pub(super) fn bowed_in_space(&self, row: usize) -> Option<Vec<Vector>> {
        let by = self.bows[row];
        let body = self.body_at_rest(row);
        let (Some(&from), Some(&to)) = (body.points.first(), body.points.last()) else {
            return None;
        };
        if by == 0.0 || body.plate {
            return None;
        }
        let points = self.points_in_space(row);
        let at = |p: Point| {
            let off = |q: &Vector| {
                let q = self.projection.flat_point(*q);
                (q[0] - p[0]).hypot(q[1] - p[1])
            };
            points
                .iter()
                .copied()
                .min_by(|a, b| off(a).total_cmp(&off(b)))
        };
        let (a, b) = (at(from)?, at(to)?);
        let last = (body.points.len() - 1) as f64;
        let view = &self.projection.view;
        let lifted = body.points.iter().enumerate().map(|(i, p)| {
            let on = add(a, times(sub(b, a), i as f64 / last));
            let flat = self.projection.flat_point(on);
            let off = [p[0] - flat[0], p[1] - flat[1]].map(|x| x / self.projection.scale);
            add(on, sub(times(view.right, off[0]), times(view.up, off[1])))
        });
        Some(lifted.collect())
    }

    /// Returns the points along a link between two intersecting axes whose joints are apart from the intersection.
    pub(super) fn arc_in_space(&self, row: usize) -> Option<Vec<Vector>> {
        let (link, of) = &self.links[row];
        let &[i, j] = of.as_slice() else { return None };
        let (a, b) = (&self.places[i], &self.places[j]);
        if !(a.moved && b.moved) || self.is_frame(*link) || self.points_of(*link).next().is_some() {
            return None;
        }
        let near = MEET * norm(sub(b.point, a.point));
        let on = meeting_parameter(a.point, a.z, b.point, b.z, near)?;
        let centre = add(a.point, times(a.z, on));
        let [from, to] = [a, b].map(|p| sub(p.point, centre));
        let angle = norm(cross(from, to)).atan2(dot(from, to));
        let (near, far) = (norm(from), norm(to));
        if near < 1e-9 * far || far < 1e-9 * near || !(1e-3..=3.1).contains(&angle) {
            return None;
        }
        let (u, v) = (unit(from), unit(to));
        let at = |n: i32| {
            let t = f64::from(n) / f64::from(PIECES);
            let parts = [(1.0 - t) * angle, t * angle].map(|x| x.sin() / angle.sin());
            let out = add(times(u, parts[0]), times(v, parts[1]));
            add(centre, times(out, near + t * (far - near)))
        };
        Some((0..=PIECES).map(at).collect())
    }
}

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
