//! Arrows on links, for forces and moments: what they are in space and how they look from a side.

use crate::draw::place::projection::{Vector, View, dot, norm as norm3};
use crate::draw::sheet::Shape;
use crate::svg::plane::{Point, add, plane_norm, scale, sub, unit};
use std::f64::consts::{PI, TAU};

/// An arrow with a greater part of it towards the reader is seen from its end.
const END_ON: f64 = 0.9;
/// A moment seen from its end is an arc whose radius is this part of the arrow's length.
const ARC: f64 = 0.3;
/// A head's length.
const HEAD: f64 = 8.0;

/// An arrow in space.
#[derive(Debug, Clone)]
pub(super) struct Arrow {
    /// The place of its link among those drawn.
    pub(super) link: usize,
    /// Its start.
    pub(super) at: Vector,
    /// From its beginning to its tip, in pixels; a moment turns about it to the right.
    pub(super) along: Vector,
    /// Whether it is a moment.
    pub(super) turns: bool,
    /// Its tooltip.
    pub(super) tip: String,
}

/// Returns the shapes of an arrow that begins at a point of the paper.
pub(super) fn arrow_outline(at: Point, arrow: &Arrow, view: &View) -> Vec<Shape> {
    let class = if arrow.turns { "moment" } else { "force" };
    let to = view.flat_vector(arrow.along);
    let (length, toward) = (norm3(arrow.along), dot(arrow.along, view.toward));
    if arrow.turns && toward.abs() > END_ON * length {
        let radius = ARC * length;
        // to the left as seen from its tip; y goes down on paper
        let on = |i: i32| {
            let angle = -toward.signum() * 1.5 * PI * f64::from(i) / 24.0;
            add(at, [radius * angle.cos(), radius * angle.sin()])
        };
        let arc: Vec<Point> = (0..=24).map(on).collect();
        let back = unit(sub(arc[22], arc[24]));
        let head = arrow_head(arc[24], back, (0.8 * radius).min(HEAD), class);
        return vec![Shape::line(class, arc), head];
    }
    if toward.abs() > END_ON * length {
        // the point of an arrow that comes, the feathers of one that goes
        let (d, r) = (0.07 * length, 0.1 * length);
        let rim = (0..=24).map(|i| {
            let angle = TAU * f64::from(i) / 24.0;
            add(at, [r * angle.cos(), r * angle.sin()])
        });
        let line = |points: Vec<Point>| Shape::line(class, points);
        let inside = if toward > 0.0 {
            vec![Shape::circle(format!("{class} head"), at, 0.3 * r)]
        } else {
            [-1.0, 1.0]
                .map(|s| line(vec![add(at, [-d, -s * d]), add(at, [d, s * d])]))
                .to_vec()
        };
        return [vec![line(rim.collect())], inside].concat();
    }
    let tip = add(at, to);
    let back = scale(unit(to), -1.0);
    let size = (0.6 * plane_norm(to)).min(HEAD);
    let mut out = vec![Shape::line(class, vec![at, tip])];
    out.push(arrow_head(tip, back, size, class));
    if arrow.turns {
        out.push(arrow_head(
            add(tip, scale(back, 0.8 * size)),
            back,
            size,
            class,
        ));
    }
    out
}

fn arrow_head(tip: Point, back: Point, size: f64, class: &str) -> Shape {
    let side = scale([-back[1], back[0]], 0.4 * size);
    let foot = add(tip, scale(back, size));
    let corners = vec![tip, add(foot, side), sub(foot, side)];
    Shape::path(format!("{class} head"), corners, true)
}
