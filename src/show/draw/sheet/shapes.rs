//! Shapes of a drawing: paths and circles; polygons and bars with round corners, their hatching, and points within them.

use crate::draw::prelude::*;
use crate::svg::plane::{sides_of, twice_area};
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

/// Returns the outline of a polygon or bar, `r` away from it, with round corners.
pub(crate) fn rounded_path(corners: &[Point], r: f64) -> String {
    let n = corners.len();
    let mut d = String::new();
    let mut corners = corners.to_vec();
    if twice_area(&corners) < 0.0 {
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

/// Returns the hatching along the sides of a polygon or bar: strokes across a band of width 2 `half`.
pub(crate) fn hatch_path(corners: &[Point], half: f64, step: f64) -> String {
    let strokes = |(a, b): (Point, Point)| {
        let along = unit(sub(b, a));
        let off = scale(add(along, [-along[1], along[0]]), half);
        let room = (plane_norm(sub(b, a)) - 2.0 * half).max(0.0);
        (0..=(room / step) as i32).map(move |i| {
            let on = add(a, scale(along, half + step * f64::from(i)));
            path_data(&[sub(on, off), add(on, off)], false)
        })
    };
    sides_of(corners).flat_map(strokes).collect()
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
