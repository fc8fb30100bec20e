//! Points, segments, polygons and rectangles of a picture.

use super::xml::format_number;
pub use crate::geom::vector::{add, cross_plane as cross, dot, plane_norm, scale, sub};
use std::fmt::Write as _;

/// A point of the picture; y points down.
pub type Point = [f64; 2];

/// A rectangle of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Its left edge.
    pub left: f64,
    /// Its upper edge.
    pub top: f64,
    /// Its right edge.
    pub right: f64,
    /// Its lower edge.
    pub bottom: f64,
}

impl Rect {
    /// Returns the rectangle between four edges.
    #[must_use]
    pub const fn new(left: f64, top: f64, right: f64, bottom: f64) -> Rect {
        Rect {
            left,
            top,
            right,
            bottom,
        }
    }

    /// Returns the rectangle of a size around a middle.
    #[must_use]
    pub fn around([x, y]: Point, width: f64, height: f64) -> Rect {
        let (w, h) = (width / 2.0, height / 2.0);
        Rect::new(x - w, y - h, x + w, y + h)
    }

    /// Returns true if the two share an area.
    #[must_use]
    pub fn overlaps(&self, other: &Rect) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    /// Returns the rectangle with a margin on every side.
    #[must_use]
    pub fn grown_by(&self, by: f64) -> Rect {
        let (low, high) = (self.left - by, self.top - by);
        Rect::new(low, high, self.right + by, self.bottom + by)
    }

    /// Returns the smallest rectangle around both.
    #[must_use]
    pub fn with(&self, other: &Rect) -> Rect {
        let (left, top) = (self.left.min(other.left), self.top.min(other.top));
        let (right, bottom) = (self.right.max(other.right), self.bottom.max(other.bottom));
        Rect::new(left, top, right, bottom)
    }

    /// Returns its left, top, right and bottom edge.
    pub fn edges(&self) -> [f64; 4] {
        [self.left, self.top, self.right, self.bottom]
    }

    /// Returns its middle.
    #[must_use]
    pub fn middle(&self) -> Point {
        [
            (self.left + self.right) / 2.0,
            (self.top + self.bottom) / 2.0,
        ]
    }

    /// Returns its point nearest to `p`.
    pub fn nearest_point(&self, p: Point) -> Point {
        [
            p[0].clamp(self.left, self.right),
            p[1].clamp(self.top, self.bottom),
        ]
    }

    /// Returns it moved.
    pub fn moved_by(&self, [x, y]: Point) -> Rect {
        let (left, top) = (self.left + x, self.top + y);
        Rect::new(left, top, self.right + x, self.bottom + y)
    }

    /// Returns true if a segment touches it.
    pub fn meets_segment(&self, a: Point, b: Point) -> bool {
        let within = |p: Point| {
            (self.left..=self.right).contains(&p[0]) && (self.top..=self.bottom).contains(&p[1])
        };
        let corners = [
            [self.left, self.top],
            [self.right, self.top],
            [self.right, self.bottom],
            [self.left, self.bottom],
        ];
        within(a)
            || within(b)
            || segments_cross(a, b, corners[0], corners[2])
            || segments_cross(a, b, corners[1], corners[3])
    }
}

/// Returns the smallest rectangle around some points, or an empty one at the origin.
pub fn bounds_of(points: &[Point]) -> Rect {
    let all = points.iter().map(|&p| Rect::around(p, 0.0, 0.0));
    let all = all.reduce(|a, b| a.with(&b));
    all.unwrap_or(Rect::new(0.0, 0.0, 0.0, 0.0))
}

/// Returns the mean of some points, or the origin if there are none.
pub fn mean(points: impl Iterator<Item = Point>) -> Point {
    let (mut sum, mut n) = ([0.0, 0.0], 0.0f64);
    for p in points {
        sum = add(sum, p);
        n += 1.0;
    }
    scale(sum, 1.0 / n.max(1.0))
}

/// Returns the direction of a vector, or the horizontal one if it has none.
pub fn unit(a: Point) -> Point {
    let length = plane_norm(a);
    if length > 1e-12 {
        scale(a, 1.0 / length)
    } else {
        [1.0, 0.0]
    }
}

/// Returns the distance of a point from a segment.
pub fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    let along = sub(b, a);
    let length = dot(along, along);
    let t = if length > 1e-18 {
        (dot(sub(p, a), along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    plane_norm(sub(p, add(a, scale(along, t))))
}

/// Returns true if two segments share no value of one coordinate.
pub fn are_apart([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    (0..2).any(|k| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]))
}

/// Returns true if two segments cross, not counting ends.
pub fn segments_cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p, q, r| cross(sub(q, p), sub(r, p));
    side(a, b, c) * side(a, b, d) < -1e-15 && side(c, d, a) * side(c, d, b) < -1e-15
}

/// Returns the sides of a polygon by its corners, or the only side of a bar by its ends.
pub fn sides_of<T: Copy>(corners: &[T]) -> impl Iterator<Item = (T, T)> + Clone + '_ {
    let n = corners.len();
    let count = if n > 2 { n } else { n.saturating_sub(1) };
    (0..count).map(move |i| (corners[i], corners[(i + 1) % n]))
}

/// Returns twice the area of a polygon, negative if it turns to the left on paper.
pub fn twice_area(polygon: &[Point]) -> f64 {
    let sides = sides_of(polygon).filter(|_| polygon.len() > 2);
    sides.map(|(a, b)| cross(a, b)).sum()
}

/// Returns the area of a polygon.
pub fn polygon_area(polygon: &[Point]) -> f64 {
    twice_area(polygon).abs() / 2.0
}

/// Returns true if a point is inside a polygon (even-odd).
pub fn is_inside(p: Point, polygon: &[Point]) -> bool {
    let mut odd = false;
    for (a, b) in sides_of(polygon).filter(|_| polygon.len() > 2) {
        if (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        {
            odd = !odd;
        }
    }
    odd
}

/// Returns the data of the path through some points.
pub fn path_data(points: &[Point], closed: bool) -> String {
    let mut d = String::new();
    for (i, p) in points.iter().enumerate() {
        let c = if i == 0 { 'M' } else { 'L' };
        // writing to a string does not fail
        let _ = write!(d, "{c}{} {}", format_number(p[0]), format_number(p[1]));
    }
    if closed {
        d.push('Z');
    }
    d
}
