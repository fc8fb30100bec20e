//! Placement of the names of joints and links.

use crate::draw::kinematic::{Kinematic, MovingPicture, Spot};
use crate::draw::naming::{Name, place_names};
use crate::draw::prelude::*;
use crate::draw::symbol::ground::Ground;
use crate::svg::labels::{AvoidedLine, CROSSED, LabelPlace};

impl Kinematic<'_> {
    /// Returns the places and texts of the ids of joints, links and points of interest, in this order.
    pub(super) fn place_labels(&self, rest: &MovingPicture) -> Vec<(LabelPlace, Name)> {
        let mut taken: Vec<Rect> = self.spots.iter().map(|s| s.rect).collect();
        taken.extend(self.grounds.iter().map(Ground::ground_room));
        taken.extend(self.points.iter().map(|p| Rect::around(p.at, 9.0, 9.0)));
        let lines = self.drawn_lines(rest).into_iter().map(|ends| AvoidedLine {
            ends,
            weight: CROSSED,
        });
        let lines: Vec<AvoidedLine> = lines.collect();
        let spot = |s: &Spot| {
            let half = [s.rect.right - s.rect.left, s.rect.bottom - s.rect.top];
            (s.joint, s.at, half[0].min(half[1]) / 2.0)
        };
        let spots: Vec<_> = self.spots.iter().map(spot).collect();
        let links: Vec<LinkId> = self.links.iter().map(|(l, _)| *l).collect();
        let of_links = self
            .subject
            .link_names(&links, |n, width| self.link_places(rest, n, [width, 13.0]));
        let names = [
            self.subject.joint_names(&spots),
            of_links,
            self.point_names(),
        ]
        .concat();
        place_names(names, &mut taken, &lines)
    }

    /// Returns the segments of everything that is drawn, which no label may cover.
    fn drawn_lines(&self, rest: &MovingPicture) -> Vec<(Point, Point)> {
        let wires = rest.wires.iter();
        let mut lines: Vec<_> = wires.flat_map(|w| w.segments()).collect();
        lines.extend(self.grounds.iter().filter_map(Ground::stem_line));
        lines.extend(self.coupling_lines());
        for way in &self.traces.0 {
            lines.extend(way.windows(2).map(|w| (w[0], w[1])));
        }
        for shape in self.arrows.iter().flat_map(|a| self.arrow_shapes(a)) {
            lines.extend(shape.path_points().windows(2).map(|w| (w[0], w[1])));
        }
        lines
    }

    /// Returns the ids of points of interest.
    fn point_names(&self) -> Vec<Name> {
        let ids: Vec<&str> = self.points.iter().map(|p| p.id.as_str()).collect();
        let texts = shorten_names(&ids, SMALL, 150.0);
        let named = self.points.iter().zip(texts);
        named
            .map(|(p, text)| Name::small("small soft".to_owned(), text, p.at, 5.0))
            .collect()
    }

    /// Returns the anchor of the name of a link, its distance from it, and preferred middles.
    fn link_places(
        &self,
        rest: &MovingPicture,
        link: usize,
        size: Point,
    ) -> (Point, f64, Vec<(Point, f64)>) {
        let (l, of) = &self.links[link];
        if self.is_frame(*l) {
            let first = self.grounds.first();
            return (first.map_or([0.0; 2], |g| g.to), 2.0, Vec::new());
        }
        let own = rest.wires.iter().find(|w| w.link && w.row == link);
        let Some(own) = own.filter(|w| w.points.len() > 1) else {
            // all its joints are in one place
            return (self.spots[of[0]].at, 2.0, Vec::new());
        };
        let middle = own.middle();
        if own.closed {
            return (middle, 2.0, vec![(middle, 0.0)]);
        }
        let [a, b] = [own.points[0], own.points[own.points.len() - 1]];
        let bow = sub(middle, scale(add(a, b), 0.5));
        let along = sub(b, a);
        let side = unit([-along[1], along[0]]);
        // so far that the box just misses the bar
        let off = (size[0] * side[0].abs() + size[1] * side[1].abs()) / 2.0 + 4.0;
        let mut first = Vec::new();
        for (n, t) in [0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74].iter().enumerate() {
            let on = add(add(a, scale(along, *t)), bow);
            for s in [off, -off] {
                first.push((add(on, scale(side, s)), 0.08 * n as f64));
            }
        }
        (middle, 2.0, first)
    }
}
