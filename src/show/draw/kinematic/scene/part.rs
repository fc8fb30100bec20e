//! What a program that turns and moves a scene has of its symbols, as numbers in the frame of a joint or on paper, and of what its joints
//! leave free and couple.

use crate::draw::kinematic::Kinematic;
use crate::draw::place::projection::Vector;
use crate::draw::sheet::Shape;
use crate::draw::symbol::pieces::{ALWAYS, Form, Piece};
use crate::model::joint_type::{Coupling, Freedom, JointType};
use crate::model::mechanism::JointId;
use crate::svg::plane::Point;
use serde_json::{Value, json};

/// What goes along an axis, by the axis and by whether it is closed.
const ALONG: [[&str; 2]; 3] = [
    ["along x", "along x loop"],
    ["along y", "along y loop"],
    ["along z", "along z loop"],
];

/// To a hundredth of a pixel.
pub(in crate::draw::kinematic) fn tidy(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

/// Returns a piece of a symbol: the numbers of a [`Form`].
pub(in crate::draw::kinematic) fn part(p: &Piece, mark: &str, size: f64) -> Value {
    let all = |points: &[Vector]| json!(points.iter().map(|p| scaled(p, size)).collect::<Vec<_>>());
    let flat = |points: &[Point]| json!(points.iter().map(|p| scaled(p, size)).collect::<Vec<_>>());
    let (form, points, radius) = match &p.form {
        Form::Hull(points, round) => ("hull", all(points), *round),
        Form::Face(points) => ("face", all(points), 0.0),
        Form::Line(points) => ("line", all(points), 0.0),
        Form::Ball(at, radius) => ("ball", all(&[*at]), *radius),
        Form::Along(axis, points, closed) => {
            (ALONG[*axis][usize::from(*closed)], flat(points), 0.0)
        }
        Form::Paper(points, closed) => (line(*closed), flat(points), 0.0),
    };
    json!({
        "form": form,
        "class": format!("{}{mark}", p.class),
        "points": points,
        "radius": tidy(radius * size),
        "seen": [p.seen.start, p.seen.end],
    })
}

fn scaled<const N: usize>(p: &[f64; N], size: f64) -> Vec<f64> {
    p.iter().map(|x| tidy(x * size)).collect()
}

fn line(closed: bool) -> &'static str {
    if closed { "loop" } else { "line" }
}

pub(in crate::draw::kinematic) fn paper(class: &str, points: &[Point], closed: bool) -> Value {
    let piece = Piece {
        class: "",
        form: Form::Paper(points.to_vec(), closed),
        seen: ALWAYS,
    };
    part(&piece, class, 1.0)
}

/// A finished shape, turned to the reader always.
pub(in crate::draw::kinematic) fn flat(shape: &Shape) -> Value {
    match shape {
        Shape::Path {
            class,
            points,
            closed,
        } => paper(class, points, *closed),
        Shape::Circle { at, radius, class } => {
            let mut ball = paper(class, &[*at], false);
            ball["form"] = json!("ball");
            ball["radius"] = json!(tidy(*radius));
            ball
        }
    }
}

/// The ground below a joint.
pub(in crate::draw::kinematic) fn below(reach: f64) -> Vec<Value> {
    let strokes = (0..5).map(|i| {
        let x = 10.0 - 5.0 * f64::from(i);
        paper("fine", &[[x, reach], [x - 4.0, reach + 6.0]], false)
    });
    let stem = paper("bone", &[[0.0, 0.0], [0.0, reach]], false);
    let line = paper("bone", &[[-11.0, reach], [11.0, reach]], false);
    [stem, line].into_iter().chain(strokes).collect()
}

impl Kinematic<'_> {
    /// Returns what a type leaves free at a joint: its freedoms in order, where slides go along axes of the second link where turns come
    /// before them.
    pub(in crate::draw::kinematic) fn pair(&self, i: usize, of: &JointType) -> Value {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let free = of.freedoms();
        let screws = free.contains(&Freedom::Screw);
        let pitch = if screws {
            joint.frame.pitch.to_f64()
        } else {
            0.0
        };
        json!({
            "free": free.iter().map(|f| f.name()).collect::<Vec<_>>(),
            // Whether the first of the scene's two links is the joint's second.
            "swapped": self.carriers(i).0 != joint.links[0],
            // Pixels along z for each radian about it, of a screw.
            "pitch": pitch * self.projection.scale,
        })
    }

    /// Returns a coupling between joints of a scene, in radians and pixels: factor by factor, the changes of the two freedoms add up to 0;
    /// none where one of them is not drawn.
    pub(in crate::draw::kinematic) fn tie(
        &self,
        coupling: &Coupling,
        row: impl Fn(JointId) -> Option<usize>,
    ) -> Option<Value> {
        let [a, b] = coupling.ends;
        let unit = |f: Freedom| {
            if f.slides() {
                self.projection.scale
            } else {
                1.0
            }
        };
        // the rate of the second is the ratio times the rate of the first
        let factors = [coupling.ratio.to_f64(), -1.0];
        Some(json!({
            "joints": [row(a.joint)?, row(b.joint)?],
            "freedoms": [a.freedom.name(), b.freedom.name()],
            "factors": [factors[0] / unit(a.freedom), factors[1] / unit(b.freedom)],
        }))
    }
}
