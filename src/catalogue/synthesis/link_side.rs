//! Sides of links, and what lies on them or crosses them.

use crate::geom::vector::{cross_plane, dot, length, sub};
use crate::synthesis::point::Point;
use itertools::Itertools;

/// A pin nearer than this to a link that it is no part of lies on it.
pub(super) const ON: f64 = 6.0;

pub(super) fn crosses([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |p: Point, q: Point, r: Point| cross_plane(sub(q, p), sub(r, p)) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

pub(super) fn distance(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (along, to) = (sub(b, a), sub(p, a));
    let t = (dot(to, along) / dot(along, along).max(1e-9)).clamp(0.0, 1.0);
    length(sub(to, along.map(|x| x * t)))
}

/// A side of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LinkSide {
    pub(super) link: usize,
    /// The points at its ends.
    pub(super) ends: [usize; 2],
}

impl LinkSide {
    /// Where its ends are.
    pub(super) fn of(&self, at: &[Point]) -> [Point; 2] {
        self.ends.map(|i| at[i])
    }
}

/// Whether a link of these sides, a bar or a plate, lies over a point.
pub(super) fn lies_over(sides: &[LinkSide], at: &[Point], point: Point) -> bool {
    let near = |side: &LinkSide| distance(point, side.of(at)) < ON;
    let left = |side: &LinkSide| {
        let [a, b] = side.of(at);
        cross_plane(sub(b, a), sub(point, a)) > 0.0
    };
    let within = sides.len() > 2 && sides.iter().map(left).all_equal();
    within || sides.iter().any(near)
}
