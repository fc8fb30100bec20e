//! Shapes of a drawing: paths and circles; polygons and bars with round corners, their hatching, and points within them.

use crate::draw::prelude::*;
use crate::svg::xml::format_number;

/// A finished piece of drawing.
#[derive(Debug, Clone)]
pub(crate) enum Shape {
    /// A path.
    Path {
        class: String,
        points: Vec<Point>,
        closed: bool,
    },
    /// A circle.
    Circle {
        at: Point,
        radius: f64,
        class: String,
    },
}

impl Shape {
    /// Returns the points of a path. Empty for a circle.
    pub(crate) fn path_points(&self) -> &[Point] {
        match self {
            Shape::Path { points, .. } => points,
            Shape::Circle { .. } => &[],
        }
    }

    /// Returns a path.
    pub(crate) fn path(class: impl Into<String>, points: Vec<Point>, closed: bool) -> Shape {
        Shape::Path {
            class: class.into(),
            points,
            closed,
        }
    }

    /// Returns an open path.
    pub(crate) fn line(class: impl Into<String>, points: Vec<Point>) -> Shape {
        Shape::path(class, points, false)
    }

    /// Returns a circle.
    pub(crate) fn circle(class: impl Into<String>, at: Point, radius: f64) -> Shape {
        let class = class.into();
        Shape::Circle { at, radius, class }
    }
}

/// Half the width of a bar.
pub(crate) const HALF: f64 = 8.5;

/// Returns the sides of a polygon, or the pieces of a bar.
pub(crate) fn outline_sides(corners: &[Point]) -> Vec<(Point, Point)> {
    let open = corners.len() < 3;
    let count = corners.len() - usize::from(open && !corners.is_empty());
    (0..count)
        .map(|i| (corners[i], corners[(i + 1) % corners.len()]))
        .collect()
}

/// Returns the outline of a polygon or bar, `r` away from it, with round corners.
pub(crate) fn rounded_path(corners: &[Point], r: f64) -> String {
    let n = corners.len();
    let mut d = String::new();
    let turn: f64 = (0..n)
        .map(|i| cross(corners[i], corners[(i + 1) % n]))
        .sum();
    let mut corners = corners.to_vec();
    if turn < 0.0 {
        corners.reverse();
    }
    let normal = |i: usize| {
        let along = unit(sub(corners[(i + 1) % n], corners[i % n]));
        [along[1], -along[0]]
    };
    for (i, &corner) in corners.iter().enumerate() {
        let (before, after) = (normal(i + n - 1), normal(i));
        let hollow = cross(before, after) < -1e-9;
        let c = if i == 0 { 'M' } else { 'L' };
        if hollow {
            let miter = (1.0 + dot(before, after)).max(0.3);
            let p = add(corner, scale(add(before, after), r / miter));
            let _ = write!(d, "{c}{} {}", format_number(p[0]), format_number(p[1]));
        } else {
            let (p, q) = (add(corner, scale(before, r)), add(corner, scale(after, r)));
            let _ = write!(
                d,
                "{c}{} {}A{r} {r} 0 0 1 {} {}",
                format_number(p[0]),
                format_number(p[1]),
                format_number(q[0]),
                format_number(q[1])
            );
        }
    }
    d.push('Z');
    d
}

/// Returns the hatching within a polygon or bar.
pub(crate) fn hatch_path(corners: &[Point]) -> String {
    hatch_with(corners, HALF - 1.0, 6.5)
}

pub(crate) fn hatch_with(corners: &[Point], half: f64, step: f64) -> String {
    // a polygon that stands for the outline: arcs as short lines
    let mut area: Vec<Vec<Point>> = Vec::new();
    for (a, b) in outline_sides(corners) {
        let along = unit(sub(b, a));
        let start = (-along[0]).atan2(along[1]);
        let arc = |from: f64, at: Point| {
            (0..=12).map(move |i| {
                let angle = from + std::f64::consts::PI * f64::from(i) / 12.0;
                add(at, [half * angle.cos(), half * angle.sin()])
            })
        };
        area.push(
            arc(start, b)
                .chain(arc(start + std::f64::consts::PI, a))
                .collect(),
        );
    }
    if corners.len() > 2 {
        area.push(corners.to_vec());
    }
    let across = |p: Point| p[0] + p[1];
    let all = area.iter().flatten().map(|&p| across(p));
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (l.min(v), h.max(v))
    });
    let mut d = String::new();
    let mut level = low + step;
    let gap = step * std::f64::consts::SQRT_2;
    while level < high && d.len() < 40_000 {
        for (a, b) in level_spans(&area, level) {
            let (x1, x2) = ((level + a) / 2.0, (level + b) / 2.0);
            let _ = write!(
                d,
                "M{} {}L{} {}",
                format_number(x1),
                format_number(level - x1),
                format_number(x2),
                format_number(level - x2)
            );
        }
        level += gap;
    }
    d
}

/// Returns the intersection of the line x + y = level with a union of polygons, as ranges of x - y.
fn level_spans(area: &[Vec<Point>], level: f64) -> Vec<(f64, f64)> {
    let mut ranges: Vec<(f64, f64)> = Vec::new();
    for polygon in area {
        let mut cuts: Vec<f64> = Vec::new();
        for (i, &a) in polygon.iter().enumerate() {
            let b = polygon[(i + 1) % polygon.len()];
            let (s, t) = (a[0] + a[1] - level, b[0] + b[1] - level);
            if (s > 0.0) != (t > 0.0) {
                let f = s / (s - t);
                cuts.push((a[0] - a[1]) * (1.0 - f) + (b[0] - b[1]) * f);
            }
        }
        cuts.sort_by(f64::total_cmp);
        ranges.extend(cuts.chunks_exact(2).map(|c| (c[0], c[1])));
    }
    ranges.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out: Vec<(f64, f64)> = Vec::new();
    for r in ranges {
        match out.last_mut() {
            Some(last) if r.0 <= last.1 => last.1 = last.1.max(r.1),
            _ => out.push(r),
        }
    }
    out
}

/// Returns the points of a grid within a polygon.
pub(crate) fn grid_points(polygon: &[Point], steps: usize) -> Vec<Point> {
    let [left, top, right, bottom] = bounds_of(polygon).edges();
    let all = (0..steps).flat_map(|i| (0..steps).map(move |j| [i, j]));
    let at = |cell: [usize; 2]| {
        let [x, y] = cell.map(|k| (k as f64 + 0.5) / steps as f64);
        [left + (right - left) * x, top + (bottom - top) * y]
    };
    all.map(at).filter(|&p| is_inside(p, polygon)).collect()
}
