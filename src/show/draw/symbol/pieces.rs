//! Pieces of symbols in the frame of a joint, and how they look from a side.

use crate::draw::prelude::*;
use crate::svg::plane::twice_area;
use serde::{Deserialize, Serialize};

/// A joint's frame on paper.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PaperPose {
    axes: [Point; 3],
    toward: Vector,
}

impl PaperPose {
    /// Creates the pose of a joint seen in a view.
    pub(crate) fn new(place: &JointInSpace, view: &View) -> PaperPose {
        PaperPose::of_axes([place.x, place.y, place.z], view)
    }

    /// Creates the pose of a frame with these axes.
    pub(crate) fn of_axes(axes: [Vector; 3], view: &View) -> PaperPose {
        PaperPose {
            axes: axes.map(|a| view.flat_vector(a)),
            toward: axes.map(|a| dot(a, view.toward)),
        }
    }

    /// Returns the position of a point of three numbers. A point of two numbers lies along an axis, or is fixed on
    /// paper.
    fn place_of(&self, p: &[f64], along: Option<usize>) -> Point {
        match (p, along) {
            (&[x, y], Some(axis)) => {
                let axis = self.axes[axis];
                add(scale(axis, x), scale(upper_side(axis), y))
            }
            (&[x, y], None) => [x, y],
            _ => {
                let parts = self.axes.iter().zip(p).map(|(a, x)| scale(*a, *x));
                parts.fold([0.0; 2], add)
            }
        }
    }
}

/// A piece of a symbol, in pixels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Piece {
    form: Form,
    /// The class of the style sheet.
    class: String,
    /// In the frame of the joint; points of two numbers lie on paper, whatever the view.
    points: Vec<Vec<f64>>,
    /// The radius of a ball, or of the circles on paper at the points of a hull.
    #[serde(default)]
    radius: f64,
    /// The axis of points of two numbers. The piece is hidden if the axis is seen from its end.
    #[serde(default)]
    along: Option<usize>,
    /// The range of the share of the axis z towards the reader in which the piece is visible.
    #[serde(default = "always_seen")]
    seen: [f64; 2],
}

/// The kind of a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Form {
    /// All between the points.
    Hull,
    /// A polygon seen from its front only, where its corners run counter-clockwise.
    Face,
    /// A line through the points.
    Line,
    /// A polygon.
    Loop,
    /// A ball at the only point.
    Ball,
}

fn always_seen() -> [f64; 2] {
    [0.0, 2.0]
}

/// The share of an axis towards the reader from which it counts as seen from its end.
const END_ON: f64 = 0.9;
/// Faces smaller than this, in square pixels, are seen from the side.
const EDGE: f64 = 0.05;

/// Returns a coordinate rounded to a hundredth of a pixel.
pub(crate) fn round_hundredth(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

impl Piece {
    /// Returns a shape that always faces the reader.
    pub(crate) fn on_paper(shape: &Shape) -> Piece {
        let (form, class, points, radius) = match shape {
            Shape::Path {
                class,
                points,
                closed,
            } => {
                let form = if *closed { Form::Loop } else { Form::Line };
                (form, class, points.clone(), 0.0)
            }
            Shape::Circle { at, radius, class } => {
                (Form::Ball, class, vec![*at], round_hundredth(*radius))
            }
        };
        let points = points
            .iter()
            .map(|p| p.map(round_hundredth).to_vec())
            .collect();
        Piece {
            form,
            class: class.clone(),
            points,
            radius,
            along: None,
            seen: always_seen(),
        }
    }

    /// Returns the piece scaled; `mark` is added to the class.
    pub(crate) fn sized_piece(&self, mark: &str, size: f64) -> Piece {
        let points = self.points.iter();
        let points = points.map(|p| p.iter().map(|x| round_hundredth(x * size)).collect());
        Piece {
            class: format!("{}{mark}", self.class),
            points: points.collect(),
            radius: round_hundredth(self.radius * size),
            ..self.clone()
        }
    }

    /// Returns its shape in a pose, or `None` if it is hidden.
    pub(crate) fn shape_seen(&self, pose: &PaperPose) -> Option<Shape> {
        let ahead = pose.toward[2].abs();
        let ended = self.along.is_some_and(|a| pose.toward[a].abs() >= END_ON);
        if ended || ahead < self.seen[0] || ahead >= self.seen[1] {
            return None;
        }
        let points = self.points.iter();
        let points: Vec<Point> = points.map(|p| pose.place_of(p, self.along)).collect();
        let class = self.class.clone();
        Some(match self.form {
            Form::Ball => Shape::circle(class, mean(points.into_iter()), self.radius),
            Form::Line => Shape::line(class, points),
            // y goes down on paper
            Form::Face if twice_area(&points) > -EDGE => return None,
            Form::Face | Form::Loop => Shape::path(class, points, true),
            Form::Hull => {
                let discs = points.into_iter().flat_map(|p| disc_points(p, self.radius));
                Shape::path(class, convex_hull(discs.collect()), true)
            }
        })
    }
}

/// Returns the upward perpendicular of a direction on paper. If the direction itself is vertical, returns the side without a
/// rail.
fn upper_side(along: Point) -> Point {
    let [x, y] = unit(along);
    let side = [y, -x];
    if side[1] > 1e-9 { [-y, x] } else { side }
}

/// Returns a circle as a polygon. Returns a single point if the radius is 0.
fn disc_points(at: Point, radius: f64) -> impl Iterator<Item = Point> {
    let corners = if radius > 0.0 { 24 } else { 1 };
    (0..corners).map(move |i| {
        let angle = TAU * f64::from(i) / 24.0;
        add(at, [radius * angle.cos(), radius * angle.sin()])
    })
}

/// Returns the convex hull, by monotone chains.
pub(crate) fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
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
                if cross(a, b) > 1e-9 * plane_norm(a) * plane_norm(b) {
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
