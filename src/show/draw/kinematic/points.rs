//! Points of interest in a kinematic scheme, and the ways of points over a motion.

use super::Kinematic;
use super::marked::{Marked, draw_mark};
use crate::draw::sheet::{Sheet, Swatch};
use crate::model::mechanism::LinkId;
use crate::svg::plane::{Point, add, polyline};

impl Kinematic<'_> {
    /// The points of a link.
    pub(super) fn points_of(&self, link: LinkId) -> impl Iterator<Item = &Marked> {
        self.points.iter().filter(move |p| p.link == link)
    }

    /// All points of the ways.
    pub(super) fn traced(&self) -> impl Iterator<Item = Point> + '_ {
        self.traces.0.iter().flatten().copied()
    }

    pub(super) fn shift_points(&mut self, by: Point) {
        let ways = self.traces.0.iter_mut().flatten();
        for p in self.points.iter_mut().map(|p| &mut p.at).chain(ways) {
            *p = add(*p, by);
        }
    }

    pub(super) fn draw_traces(&self, sheet: &mut Sheet) {
        let (ways, closed) = &self.traces;
        for way in ways {
            sheet.path("trace", &polyline(way, *closed));
        }
    }

    pub(super) fn draw_points(&self, sheet: &mut Sheet) {
        for p in &self.points {
            sheet.group("data-point", &p.id, [0.0; 2], |s| draw_mark(s, p.at));
        }
    }

    /// What the legend says of points and ways.
    pub(super) fn point_rows(&self) -> Vec<(Swatch, String)> {
        let mut out = Vec::new();
        if !self.points.is_empty() {
            out.push((
                Swatch::Symbol(draw_mark),
                "point of interest, or face of a jaw".to_owned(),
            ));
        }
        if !self.traces.0.is_empty() {
            let draw =
                |s: &mut Sheet, p: Point| s.line("trace", add(p, [-9.0, 0.0]), add(p, [9.0, 0.0]));
            let of = if self.points.is_empty() {
                "way of a point of the output"
            } else {
                "way of a point"
            };
            out.push((Swatch::Symbol(draw), of.to_owned()));
        }
        out
    }
}
