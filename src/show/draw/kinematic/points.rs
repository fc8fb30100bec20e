//! Points of interest in a kinematic scheme, and the ways of points over a motion.

use super::Kinematic;
use super::body::{Marked, draw_mark};
use crate::draw::kinematic::moving::sliding::Carried;
use crate::draw::place::projection::{Vector, add as add3, scale as times};
use crate::draw::sheet::{Sheet, Swatch};
use crate::draw::symbol::placed::one_place;
use crate::model::mechanism::LinkId;
use crate::svg::plane::{Point, path_data, sub};

impl Kinematic<'_> {
    /// Returns the points of a link.
    pub(super) fn points_of(&self, link: LinkId) -> impl Iterator<Item = &Marked> {
        self.points.iter().filter(move |p| p.link == link)
    }

    /// Returns all points of the paths.
    pub(super) fn traced_points(&self) -> impl Iterator<Item = Point> + '_ {
        self.traces.0.iter().flatten().copied()
    }

    pub(super) fn draw_traces(&self, sheet: &mut Sheet) {
        let (ways, closed) = &self.traces;
        for way in ways {
            sheet.draw_path("trace", &path_data(way, *closed));
        }
    }

    /// Returns the legend rows of points and their paths.
    pub(super) fn point_rows(&self) -> Vec<(Swatch, String)> {
        let mut out = Vec::new();
        if !self.points.is_empty() {
            let mark = |s: &mut Sheet| draw_mark(s, [0.0; 2]);
            let text = "point of interest, or face of a jaw".to_owned();
            out.push((Swatch::Symbol(mark), text));
        }
        if !self.traces.0.is_empty() {
            let of = if self.points.is_empty() {
                "way of a point of the output"
            } else {
                "way of a point"
            };
            out.push((Swatch::line("trace"), of.to_owned()));
        }
        out
    }

    /// Returns the path of each point that is shown.
    pub(super) fn traced_ways(&self, poses: &[Carried<'_>]) -> Vec<Vec<Point>> {
        let tips = self.traced_tips().into_iter();
        let of = tips.map(|(link, tip)| {
            let at = |c: &Carried<'_>| self.projection.flat_point(c.carried_point(link, tip));
            poses.iter().map(at).collect()
        });
        of.collect()
    }

    /// Returns the points of interest. For an output link without any, returns its free end, or its joints except those
    /// on the frame.
    pub(super) fn traced_tips(&self) -> Vec<(LinkId, Vector)> {
        let moving = self.points.iter().filter(|p| !self.is_frame(p.link));
        let mut out: Vec<(LinkId, Vector)> = moving.map(|p| (p.link, p.place)).collect();
        let bare = |l: LinkId| self.is_output(l) && self.points_of(l).next().is_none();
        for (row, (l, of)) in self.links.iter().enumerate() {
            if !bare(*l) {
                continue;
            }
            let mut seen: Vec<Point> = Vec::new();
            for &i in of {
                let spot = &self.spots[i];
                let links = self.subject.mechanism.joints[spot.joint].links;
                let grounded = links.iter().any(|&l| self.is_frame(l));
                if !grounded && !seen.iter().any(|&p| one_place(p, spot.at)) {
                    seen.push(spot.at);
                    out.push((*l, self.places[i].point));
                }
            }
            out.extend(self.loose_in_space(row).map(|p| (*l, p)));
        }
        out
    }

    /// Returns the free end of a link with one joint.
    pub(super) fn loose_in_space(&self, link: usize) -> Option<Vector> {
        let of = &self.links[link].1;
        let off = sub(self.loose_end(link)?, self.spots[of[0]].at);
        let (view, scale) = (&self.projection.view, self.projection.scale);
        let across = add3(
            times(view.right, off[0] / scale),
            times(view.up, -off[1] / scale),
        );
        Some(add3(self.places[of[0]].point, across))
    }
}
