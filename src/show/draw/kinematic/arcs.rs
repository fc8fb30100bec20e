//! Links that are not straight bars: arcs about the common point of the axes in spherical linkages, and bars that bow
//! out to pass another.

use super::Kinematic;
use crate::draw::place::projection::places::meeting_parameter;
use crate::draw::place::projection::{Vector, add, cross, dot, norm, scale as times, sub};
use crate::geom::vector::unit;
use crate::svg::plane::Point;

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
