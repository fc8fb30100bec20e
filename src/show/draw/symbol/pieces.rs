//! Pieces of symbols in the frame of a joint, and how they look from a side.

use crate::draw::place::projection::{JointInSpace, Vector, View, dot};
use crate::draw::sheet::Shape;
use crate::svg::plane::{Point, add, cross, norm, scale, sub, unit};
use std::f64::consts::TAU;
use std::ops::Range;

/// A joint's frame on paper.
#[derive(Debug, Clone, Copy)]
pub(in crate::draw) struct PaperPose {
    axes: [Point; 3],
    toward: Vector,
}

impl PaperPose {
    /// Of a joint seen from a side.
    pub(in crate::draw) fn new(place: &JointInSpace, view: &View) -> PaperPose {
        PaperPose::of_axes([place.x, place.y, place.z], view)
    }

    /// Of a frame with these axes.
    pub(in crate::draw) fn of_axes(axes: [Vector; 3], view: &View) -> PaperPose {
        PaperPose {
            axes: axes.map(|a| view.flat(a)),
            toward: axes.map(|a| dot(a, view.toward)),
        }
    }

    fn at(&self, p: &Vector) -> Point {
        let parts = self.axes.iter().zip(p).map(|(a, x)| scale(*a, *x));
        parts.fold([0.0; 2], add)
    }
}

/// A piece of a symbol, in pixels.
#[derive(Debug, Clone)]
pub(in crate::draw) struct Piece {
    /// The class of the style sheet.
    pub(in crate::draw) class: &'static str,
    pub(in crate::draw) form: Form,
    /// It is there where so much of the joint's axis z points at the reader.
    pub(in crate::draw) seen: Range<f64>,
}

/// What a piece is.
#[derive(Debug, Clone)]
pub(in crate::draw) enum Form {
    /// All between some points, each with a circle on paper of a radius.
    Hull(Vec<Vector>, f64),
    /// A polygon seen from its front only, where its corners run counter-clockwise.
    Face(Vec<Vector>),
    /// A line through some points.
    Line(Vec<Vector>),
    /// A ball of a radius.
    Ball(Vector, f64),
    /// Along one of the axes, and so far beside it on paper, whatever the view: a line, or a polygon where it is closed. Not
    /// seen where the axis is seen from its end.
    Along(usize, Vec<Point>, bool),
    /// What is turned to the reader always: a line, or a polygon where it is closed.
    Paper(Vec<Point>, bool),
}

/// At any turn of the axis.
pub(in crate::draw) const ALWAYS: Range<f64> = 0.0..2.0;
/// Where so much of an axis points at the reader, it is seen from its end.
pub(in crate::draw) const END_ON: f64 = 0.9;
/// Faces smaller than this, in square pixels at the usual size, are seen from the side.
const EDGE: f64 = 0.05;

impl Piece {
    /// How it looks from a side, so many times its size; nothing where it is not seen. `mark` is added to the class.
    pub(in crate::draw) fn shape(&self, pose: &PaperPose, mark: &str, size: f64) -> Option<Shape> {
        if !self.seen.contains(&pose.toward[2].abs()) {
            return None;
        }
        let class = format!("{}{mark}", self.class);
        let flat = |points: &[Vector]| -> Vec<Point> {
            points.iter().map(|p| scale(pose.at(p), size)).collect()
        };
        let (points, closed) = match &self.form {
            Form::Hull(points, 0.0) => (hull(flat(points)), true),
            Form::Hull(points, round) => {
                let discs = flat(points).into_iter().flat_map(|p| disc(p, round * size));
                (hull(discs.collect()), true)
            }
            Form::Face(points) => {
                let points = flat(points);
                // y goes down on paper
                if turning(&points) > -EDGE * size * size {
                    return None;
                }
                (points, true)
            }
            Form::Line(points) => (flat(points), false),
            Form::Along(axis, points, closed) => {
                if pose.toward[*axis].abs() >= END_ON {
                    return None;
                }
                let (axis, side) = (pose.axes[*axis], upper_side(pose.axes[*axis]));
                let on = |p: &Point| scale(add(scale(axis, p[0]), scale(side, p[1])), size);
                (points.iter().map(on).collect(), *closed)
            }
            Form::Paper(points, closed) => {
                (points.iter().map(|&p| scale(p, size)).collect(), *closed)
            }
            Form::Ball(at, radius) => {
                return Some(Shape::Circle {
                    at: scale(pose.at(at), size),
                    radius: radius * size,
                    class,
                });
            }
        };
        Some(Shape::Path {
            class,
            points,
            closed,
        })
    }
}

/// Across a direction on paper, upwards; of one that goes up itself, to where no rail is.
fn upper_side(along: Point) -> Point {
    let [x, y] = unit(along);
    let side = [y, -x];
    if side[1] > 1e-9 { [-y, x] } else { side }
}

/// Twice the area of a polygon, below 0 where it turns to the left on paper.
fn turning(points: &[Point]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(&a, &b)| cross(a, b)).sum()
}

/// A circle as a polygon.
fn disc(at: Point, radius: f64) -> impl Iterator<Item = Point> {
    (0..24).map(move |i| {
        let angle = TAU * f64::from(i) / 24.0;
        add(at, [radius * angle.cos(), radius * angle.sin()])
    })
}

/// The convex hull, by monotone chains.
pub(in crate::draw) fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut out: Vec<Point> = Vec::new();
    for pass in 0..2 {
        let from = out.len();
        for &p in &points {
            while let [.., before, last] = out[from..] {
                let (a, b) = (sub(last, before), sub(p, last));
                // points in a row that rounding has moved are still in a row
                if cross(a, b) > 1e-9 * norm(a) * norm(b) {
                    break;
                }
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    out
}
