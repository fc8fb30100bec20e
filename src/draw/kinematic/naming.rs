//! Where the names of joints and links go.

use super::Kinematic;
use crate::draw::ground::Ground;
use crate::draw::labels::{self, Line, Wish};
use crate::draw::sheet::SMALL;
use crate::model::mechanism::LinkId;
use crate::svg::plane::{Point, Rect, add, mean, scale, sub, unit};
use crate::svg::text::{cut, width};

impl Kinematic<'_> {
    /// Where the ids of joints and links go, with their classes and sizes.
    pub(super) fn place_labels(&self) -> (Vec<labels::Place>, Vec<(String, f64, String)>) {
        let m = self.subject.mechanism;
        let mut taken: Vec<Rect> = self.spots.iter().map(|s| s.rect).collect();
        taken.extend(self.grounds.iter().map(Ground::rect));
        let mut lines = Vec::new();
        let mut add_line = |a: Point, b: Point| {
            lines.push(Line {
                ends: (a, b),
                weight: 1.6,
            });
        };
        for (l, of) in self.links.iter().filter(|(l, _)| !self.is_frame(*l)) {
            let outline = self.outline(of);
            for i in 0..outline.len() {
                if outline.len() > 2 || i + 1 < outline.len() {
                    add_line(outline[i], outline[(i + 1) % outline.len()]);
                }
            }
            if let Some(end) = self.loose(of).filter(|_| !self.is_frame(*l)) {
                add_line(self.spots[of[0]].at, end);
            }
        }
        for g in &self.grounds {
            add_line(g.from, g.to);
        }
        let (mut wishes, mut texts) = (Vec::new(), Vec::new());
        for s in &self.spots {
            let text = cut(&m.joints[s.joint].id, SMALL, 150.0);
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
        for (l, of) in &self.links {
            let text = cut(&m.links[*l].id, 12.0, 150.0);
            let size = [width(&text, 12.0), 13.0];
            let (anchor, first) = self.link_places(*l, of, size);
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
        (labels::place(&wishes, &mut taken, &lines), texts)
    }

    /// What the name of a link belongs to, and middles for it.
    fn link_places(&self, l: LinkId, of: &[usize], size: Point) -> (Point, Vec<(Point, f64)>) {
        if self.is_frame(l) {
            let first = self.grounds.first();
            return (first.map_or([0.0; 2], |g| g.to), Vec::new());
        }
        let mut outline = self.outline(of);
        let middle = mean(outline.iter().copied());
        if outline.len() > 2 {
            return (middle, vec![(middle, 0.0)]);
        }
        outline.extend(self.loose(of));
        let (Some(&a), Some(&b)) = (outline.first(), outline.last()) else {
            return (middle, Vec::new());
        };
        let along = sub(b, a);
        let side = unit([-along[1], along[0]]);
        // so far that the box just misses the bar
        let off = (size[0] * side[0].abs() + size[1] * side[1].abs()) / 2.0 + 4.0;
        let mut first = Vec::new();
        for (n, t) in [0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74].iter().enumerate() {
            let on = add(a, scale(along, *t));
            for s in [off, -off] {
                first.push((add(on, scale(side, s)), 0.08 * n as f64));
            }
        }
        (add(a, scale(along, 0.5)), first)
    }
}
