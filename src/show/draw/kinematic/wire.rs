//! Shapes fixed to links, in space: bars, plates, arcs about the common point of the axes in spherical linkages, and bars that bow out to
//! pass another.

use crate::draw::kinematic::Kinematic;
use crate::draw::kinematic::body::{Body, DrawnWire, Wire, WireForm, find_bows};
use crate::draw::place::projection::places::meeting_parameter;
use crate::draw::place::projection::{cross, norm, scale as times};
use crate::draw::prelude::*;

/// The pieces of a bowed bar, and of an arc.
const BOW: i32 = 12;
const ARC: i32 = 16;
/// Axes that pass each other by more than this share of the distance from where they meet do not meet.
const MEET: f64 = 1e-4;

impl Kinematic<'_> {
    /// Returns the shapes of the moving links. Bars that would lie on others bow out.
    pub(super) fn link_wires(&self) -> Vec<Wire> {
        let moving = (0..self.links.len()).filter(|&l| !self.is_frame(self.links[l].0));
        let wire = |row: usize| {
            let (form, points) = match self.arc_in_space(row) {
                Some(arc) => (WireForm::Arc, arc),
                None => (WireForm::Hull, self.points_in_space(row)),
            };
            let class = "";
            Wire {
                row,
                class,
                form,
                points,
            }
        };
        let mut wires: Vec<Wire> = moving.map(wire).collect();
        let hulls = wires.iter().filter(|w| w.form == WireForm::Hull);
        let bars: Vec<Option<[Point; 2]>> = hulls.map(|w| self.bar_of(&w.points)).collect();
        let hulls = wires.iter_mut().filter(|w| w.form == WireForm::Hull);
        for (wire, by) in hulls.zip(find_bows(&bars)) {
            if by != 0.0 {
                (wire.form, wire.points) = (WireForm::Bow, self.bowed_points(&wire.points, by));
            }
        }
        wires
    }

    /// Returns the points along a link between two intersecting axes whose joints are apart from the intersection.
    fn arc_in_space(&self, row: usize) -> Option<Vec<Vector>> {
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
        let (u, v) = (times(from, 1.0 / near), times(to, 1.0 / far));
        let at = |n: i32| {
            let t = f64::from(n) / f64::from(ARC);
            let parts = [(1.0 - t) * angle, t * angle].map(|x| x.sin() / angle.sin());
            let out = add(times(u, parts[0]), times(v, parts[1]));
            add(centre, times(out, near + t * (far - near)))
        };
        Some((0..=ARC).map(at).collect())
    }

    /// Returns the ends of a link on paper where it is a bar.
    fn bar_of(&self, points: &[Vector]) -> Option<[Point; 2]> {
        let flat: Vec<Point> = points
            .iter()
            .map(|&p| self.projection.flat_point(p))
            .collect();
        let body = Body::new(&flat);
        body.points.try_into().ok().filter(|_| !body.plate)
    }

    /// Returns the line of a bar that bows out to one side, in the plane of the paper.
    fn bowed_points(&self, points: &[Vector], by: f64) -> Vec<Vector> {
        let flat = |p: &Vector| self.projection.flat_point(*p);
        let Some(ends) = self.bar_of(points) else {
            return points.to_vec();
        };
        let at = |end: Point| {
            let off = |p: &&Vector| plane_norm(sub(flat(p), end));
            points.iter().min_by(|a, b| off(a).total_cmp(&off(b)))
        };
        let [Some(&a), Some(&b)] = ends.map(at) else {
            return points.to_vec();
        };
        let [x, y] = unit(sub(ends[1], ends[0]));
        let (view, scale) = (&self.projection.view, self.projection.scale);
        // y goes down on paper
        let side = sub(times(view.right, -y), times(view.up, x));
        let point = |i: i32| {
            let t = f64::from(i) / f64::from(BOW);
            let out = by * 4.0 * t * (1.0 - t) / scale;
            add(add(a, times(sub(b, a), t)), times(side, out))
        };
        (0..=BOW).map(point).collect()
    }

    /// Returns a shape on paper where `carried` puts its points.
    pub(super) fn draw_wire(&self, wire: &Wire, carried: impl Fn(Vector) -> Vector) -> DrawnWire {
        let flat = wire.points.iter();
        let flat: Vec<Point> = flat
            .map(|&p| self.projection.flat_point(carried(p)))
            .collect();
        let (link, points, closed) = match wire.form {
            WireForm::Hull => {
                let body = Body::new(&flat);
                (true, body.points, body.plate)
            }
            WireForm::Arc | WireForm::Bow => (true, flat, false),
            WireForm::Line => (false, flat, false),
            WireForm::Loop => (false, flat, true),
        };
        let class = if link {
            self.link_classes(wire.row, closed)
        } else {
            wire.class.to_owned()
        };
        DrawnWire {
            row: wire.row,
            class,
            link,
            points,
            closed,
        }
    }
}
