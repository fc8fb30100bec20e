//! Where the names of joints and links go.

use super::Kinematic;
use crate::draw::sheet::SMALL;
use crate::draw::sheet::labels::{self, AvoidedLine, CROSSED, Wish};
use crate::draw::symbol::ground::Ground;
use crate::svg::plane::{Point, Rect, add, scale, sub, unit};
use crate::svg::text::{names, width};

impl Kinematic<'_> {
    /// Where the ids of joints and links go, with their classes and sizes.
    pub(super) fn place_labels(&self) -> (Vec<labels::LabelPlace>, Vec<(String, f64, String)>) {
        let m = self.subject.mechanism;
        let mut taken: Vec<Rect> = self.spots.iter().map(|s| s.rect).collect();
        taken.extend(self.grounds.iter().map(Ground::rect));
        let mut lines = Vec::new();
        let mut add_line = |a: Point, b: Point| {
            lines.push(AvoidedLine {
                ends: (a, b),
                weight: CROSSED,
            });
        };
        for (n, (l, _)) in self.links.iter().enumerate() {
            if !self.is_frame(*l) {
                self.body(n).lines().for_each(|(a, b)| add_line(a, b));
            }
        }
        for (a, b) in self.grounds.iter().filter_map(Ground::stem) {
            add_line(a, b);
        }
        for (a, b) in self.coupling_lines() {
            add_line(a, b);
        }
        for c in self.circles().iter().flatten() {
            for (i, &p) in c.iter().enumerate() {
                add_line(p, c[(i + 1) % c.len()]);
            }
        }
        taken.extend(self.points.iter().map(|p| Rect::around(p.at, 9.0, 9.0)));
        for way in &self.traces.0 {
            way.windows(2).for_each(|w| add_line(w[0], w[1]));
        }
        for shape in self.arrows.iter().flat_map(|a| self.arrow_shapes(a)) {
            let points = shape.points();
            points.windows(2).for_each(|w| add_line(w[0], w[1]));
        }
        let (mut wishes, mut texts) = (Vec::new(), Vec::new());
        let ids: Vec<&str> = self
            .spots
            .iter()
            .map(|s| m.joints[s.joint].id.as_str())
            .collect();
        for (s, text) in self.spots.iter().zip(names(&ids, SMALL, 150.0)) {
            let half = [s.rect.right - s.rect.left, s.rect.bottom - s.rect.top];
            wishes.push(Wish {
                width: width(&text, SMALL),
                height: 12.0,
                anchor: s.at,
                clear: half[0].min(half[1]) / 2.0,
                first: Vec::new(),
            });
            let mark = self.subject.joint_mark(s.joint).class();
            texts.push((format!("small soft{mark}"), SMALL, text));
        }
        let ids: Vec<&str> = self
            .links
            .iter()
            .map(|(l, _)| m.links[*l].id.as_str())
            .collect();
        let shown = self.links.iter().zip(names(&ids, 12.0, 150.0));
        for (n, ((l, _), text)) in shown.enumerate() {
            let size = [width(&text, 12.0), 13.0];
            let (anchor, first) = self.link_places(n, size);
            wishes.push(Wish {
                width: size[0],
                height: size[1],
                anchor,
                clear: 2.0,
                first,
            });
            let mark = self.subject.link_mark(*l).class();
            texts.push((format!("name{mark}"), 12.0, text));
        }
        let ids: Vec<&str> = self.points.iter().map(|p| p.id.as_str()).collect();
        for (p, text) in self.points.iter().zip(names(&ids, SMALL, 150.0)) {
            wishes.push(Wish {
                width: width(&text, SMALL),
                height: 12.0,
                anchor: p.at,
                clear: 5.0,
                first: Vec::new(),
            });
            texts.push(("small soft".to_owned(), SMALL, text));
        }
        (labels::place(&wishes, &mut taken, &lines), texts)
    }

    /// What the name of a link belongs to, and middles for it.
    fn link_places(&self, link: usize, size: Point) -> (Point, Vec<(Point, f64)>) {
        let (l, of) = &self.links[link];
        if self.is_frame(*l) {
            let first = self.grounds.first();
            return (first.map_or([0.0; 2], |g| g.to), Vec::new());
        }
        let body = self.body(link);
        let middle = body.middle();
        if body.plate {
            return (middle, vec![(middle, 0.0)]);
        }
        let (Some(&a), Some(&b), true) = (
            body.points.first(),
            body.points.last(),
            body.points.len() > 1,
        ) else {
            // all its joints are in one place
            return (self.spots[of[0]].at, Vec::new());
        };
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
        (middle, first)
    }
}
