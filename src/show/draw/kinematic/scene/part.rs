//! What a program that turns and moves a scene has of its symbols, as numbers in the frame of a joint or on paper, and of what its joints
//! leave free and couple.

use crate::draw::kinematic::Kinematic;
use crate::draw::place::projection::Vector;
use crate::draw::sheet::Shape;
use crate::draw::symbol::pieces::{Form, Piece};
use crate::model::joint_type::{Coupling, Freedom, JointType};
use crate::model::mechanism::JointId;
use crate::svg::plane::Point;
use serde::Serialize;

/// A piece of a symbol: the numbers of a [`Form`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::draw::kinematic) struct SymbolPart {
    form: &'static str,
    class: String,
    points: Vec<Vec<f64>>,
    radius: f64,
    seen: [f64; 2],
}

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

/// A piece of a symbol.
pub(in crate::draw::kinematic) fn part(p: &Piece, mark: &str, size: f64) -> SymbolPart {
    let three = |points: &[Vector]| points.iter().map(|p| p.to_vec()).collect();
    let (form, points, radius): (_, Vec<Vec<f64>>, f64) = match &p.form {
        Form::Hull(points, round) => ("hull", three(points), *round),
        Form::Face(points) => ("face", three(points), 0.0),
        Form::Line(points) => ("line", three(points), 0.0),
        Form::Ball(at, radius) => ("ball", three(&[*at]), *radius),
        Form::Along(axis, points, closed) => {
            let points = points.iter().map(|p| p.to_vec()).collect();
            (ALONG[*axis][usize::from(*closed)], points, 0.0)
        }
        Form::Paper(points, closed) => {
            let points = points.iter().map(|p| p.to_vec()).collect();
            (if *closed { "loop" } else { "line" }, points, 0.0)
        }
    };
    let scaled = |p: Vec<f64>| p.iter().map(|x| tidy(x * size)).collect();
    SymbolPart {
        form,
        class: format!("{}{mark}", p.class),
        points: points.into_iter().map(scaled).collect(),
        radius: tidy(radius * size),
        seen: [p.seen.start, p.seen.end],
    }
}

pub(in crate::draw::kinematic) fn paper(
    class: &str,
    points: Vec<Point>,
    closed: bool,
) -> SymbolPart {
    SymbolPart {
        form: if closed { "loop" } else { "line" },
        class: class.to_owned(),
        points: points.iter().map(|p| p.map(tidy).to_vec()).collect(),
        radius: 0.0,
        seen: [0.0, 2.0],
    }
}

/// A finished shape, turned to the reader always.
pub(in crate::draw::kinematic) fn flat(shape: &Shape) -> SymbolPart {
    match shape {
        Shape::Path {
            class,
            points,
            closed,
        } => paper(class, points.clone(), *closed),
        Shape::Circle { at, radius, class } => SymbolPart {
            form: "ball",
            radius: tidy(*radius),
            ..paper(class, vec![*at], false)
        },
    }
}

/// The ground below a joint.
pub(in crate::draw::kinematic) fn below(reach: f64) -> Vec<SymbolPart> {
    let strokes = (0..5).map(|i| {
        let x = 10.0 - 5.0 * f64::from(i);
        paper("fine", vec![[x, reach], [x - 4.0, reach + 6.0]], false)
    });
    let stem = paper("bone", vec![[0.0, 0.0], [0.0, reach]], false);
    let line = paper("bone", vec![[-11.0, reach], [11.0, reach]], false);
    [stem, line].into_iter().chain(strokes).collect()
}

/// The joint between two links of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::draw::kinematic) struct Pair {
    /// Its freedoms in order: slides go along axes of the second link where turns come before them.
    free: Vec<&'static str>,
    /// Whether the first of the scene's two links is the joint's second.
    swapped: bool,
    /// Pixels along z for each radian about it, of a screw.
    pitch: f64,
}

/// Two freedoms of joints of a scene, in radians and pixels: factor by factor, their changes add up to 0.
#[derive(Debug, Clone, Serialize)]
pub(in crate::draw::kinematic) struct Tie {
    /// The joints, by their numbers among those of the scene.
    joints: [usize; 2],
    freedoms: [&'static str; 2],
    factors: [f64; 2],
}

impl Kinematic<'_> {
    /// What a type leaves free at a joint.
    pub(in crate::draw::kinematic) fn pair(&self, i: usize, of: &JointType) -> Pair {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let free = of.freedoms();
        let screws = free.contains(&Freedom::Screw);
        let pitch = if screws {
            joint.frame.pitch.to_f64()
        } else {
            0.0
        };
        Pair {
            free: free.iter().map(|f| f.name()).collect(),
            swapped: self.carriers(i).0 != joint.links[0],
            pitch: pitch * self.projection.scale,
        }
    }

    /// A coupling between joints of a scene; none where one of them is not drawn.
    pub(in crate::draw::kinematic) fn tie(
        &self,
        coupling: &Coupling,
        row: impl Fn(JointId) -> Option<usize>,
    ) -> Option<Tie> {
        let [a, b] = coupling.ends;
        let unit = |f: Freedom| {
            if f.slides() {
                self.projection.scale
            } else {
                1.0
            }
        };
        // the rate of the second is the ratio times the rate of the first
        Some(Tie {
            joints: [row(a.joint)?, row(b.joint)?],
            freedoms: [a.freedom, b.freedom].map(Freedom::name),
            factors: [
                coupling.ratio.to_f64() / unit(a.freedom),
                -1.0 / unit(b.freedom),
            ],
        })
    }
}
