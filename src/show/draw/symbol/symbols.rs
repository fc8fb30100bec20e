//! The symbols of joints, in the joints' own frames.

use crate::draw::place::projection::Vector;
use crate::draw::sheet::{ROW, Shape};
use crate::draw::symbol::pieces::{ALWAYS, END_ON, Form, PaperPose, Piece};
use crate::model::joint_type::JointType;
use crate::svg::plane::{Point, Rect, scale};
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Half the thickness of a block.
const BLOCK: f64 = 5.0;
/// The radius of a bush.
const BUSH: f64 = 5.5;
/// The radius of a tube with a ball in it.
const TUBE: f64 = 8.5;
/// How far the arms of a cross reach.
const CROSS: f64 = 9.0;
/// And those of one that slides on a rod, which has to be seen beyond them.
const SLIDING_CROSS: f64 = 6.5;
/// Half the thickness of an arm.
const ARM: f64 = 2.9;

/// How far the side of what slides along the axis of a joint is from the axis; nothing for joints without such a slide.
pub(in crate::draw) fn side_of_slide(joint: &JointType) -> Option<f64> {
    match joint {
        JointType::Prismatic => Some(BLOCK),
        JointType::Cylindrical | JointType::Helical => Some(BUSH),
        JointType::CylindricalUniversal => Some(SLIDING_CROSS),
        JointType::SphereInCylinder => Some(TUBE),
        _ => None,
    }
}

/// A cylinder seen so far from its end is its face.
const FACE_ON: f64 = 0.97;
/// From here on a thread is a spiral.
const SPIRAL: f64 = 0.8;

/// The symbol of a joint round the origin, so many times its usual size; `mark` is added to the classes.
pub(in crate::draw) fn symbol(
    joint: &JointType,
    pose: &PaperPose,
    mark: &str,
    size: f64,
) -> Vec<Shape> {
    let seen = |p: &Piece| p.shape(pose, mark, size);
    pieces(joint).iter().filter_map(seen).collect()
}

/// The pieces of a joint's symbol, from the back to the front.
pub(in crate::draw) fn pieces(joint: &JointType) -> Vec<Piece> {
    let z = |x, y, z| [x, y, z];
    match joint {
        JointType::Revolute => [
            vec![line("fine", rod(14.0), 0.0..END_ON)],
            cylinder(5.5, 7.0, z, FACE_ON),
        ]
        .concat(),
        JointType::Prismatic => sliding(17.0, cuboid([BLOCK, BLOCK, 9.5])),
        JointType::Helical => screw(),
        JointType::Cylindrical => sliding(17.0, cylinder(BUSH, 9.5, z, FACE_ON)),
        JointType::Universal => cross(CROSS),
        JointType::CylindricalUniversal => sliding(17.0, cross(SLIDING_CROSS)),
        JointType::Slotted => vec![
            joint_piece(Form::Hull(vec![[7.0, 0.0, 0.0], [-7.0, 0.0, 0.0]], 6.0)),
            ball(3.2, "ink"),
        ],
        JointType::Spherical => [round_ball(6.5), vec![socket()]].concat(),
        JointType::Planar => vec![plate(9.0, -3.0), plate(9.0, 3.0)],
        JointType::SphereInCylinder => [
            vec![line("fine", rod(15.0), ALWAYS)],
            cylinder(TUBE, 9.5, z, FACE_ON),
            round_ball(5.0),
        ]
        .concat(),
        JointType::CylinderOnPlane => [
            vec![plate(10.0, -4.5)],
            cylinder(4.5, 8.0, |a, b, c| [c, a, b], 2.0),
        ]
        .concat(),
        JointType::SphereOnPlane => [vec![plate(10.0, -5.0)], round_ball(5.0)].concat(),
        JointType::Fixed => crossed_square(5.5),
        JointType::Custom(_) => {
            let corners = vec![[0.0, -9.0], [9.0, 0.0], [0.0, 9.0], [-9.0, 0.0]];
            vec![joint_piece(Form::Paper(corners, true)), ball(2.0, "ink")]
        }
    }
}

/// Shapes made small enough for a row of the legend.
pub(in crate::draw) fn fitted(shapes: &[Shape]) -> Vec<Shape> {
    let own = extent(shapes);
    let by = (ROW - 2.0) / (own.bottom - own.top).max(1e-9);
    let scaled = |p: &Point| scale(*p, by.min(1.0));
    let one = |s: &Shape| match s {
        Shape::Path {
            class,
            points,
            closed,
        } => Shape::Path {
            class: class.clone(),
            points: points.iter().map(scaled).collect(),
            closed: *closed,
        },
        Shape::Circle { at, radius, class } => Shape::Circle {
            at: scaled(at),
            radius: radius * by.min(1.0),
            class: class.clone(),
        },
    };
    shapes.iter().map(one).collect()
}

/// The rectangle round some shapes.
pub(in crate::draw) fn extent(shapes: &[Shape]) -> Rect {
    let mut all = Rect::around([0.0; 2], 2.0, 2.0);
    for s in shapes {
        match s {
            Shape::Path { points, .. } => {
                for p in points {
                    all = all.with(&Rect::around(*p, 1.4, 1.4));
                }
            }
            Shape::Circle { at, radius, .. } => {
                all = all.with(&Rect::around(*at, 2.0 * radius + 1.4, 2.0 * radius + 1.4));
            }
        }
    }
    all
}

fn piece(class: &'static str, form: Form, seen: Range<f64>) -> Piece {
    Piece { class, form, seen }
}

fn joint_piece(form: Form) -> Piece {
    piece("joint", form, ALWAYS)
}

fn line(class: &'static str, points: Vec<Vector>, seen: Range<f64>) -> Piece {
    piece(class, Form::Line(points), seen)
}

fn ball(radius: f64, class: &'static str) -> Piece {
    piece(class, Form::Ball([0.0; 3], radius), ALWAYS)
}

/// A ball that does not look like a pin: with its equator.
fn round_ball(radius: f64) -> Vec<Piece> {
    let arc = (0..=12).map(|i| {
        let angle = PI * f64::from(i) / 12.0;
        [radius * angle.cos(), 0.36 * radius * angle.sin()]
    });
    let equator = piece("line", Form::Paper(arc.collect(), false), ALWAYS);
    vec![ball(radius, "joint"), equator]
}

/// The axis from end to end.
fn rod(half: f64) -> Vec<Vector> {
    vec![[0.0, 0.0, -half], [0.0, 0.0, half]]
}

/// What slides on a rod; the end of the rod is shown where the rod itself is not to be seen.
fn sliding(half: f64, on: Vec<Piece>) -> Vec<Piece> {
    let end = Form::Ball([0.0; 3], 3.0);
    [
        vec![line("line", rod(half), ALWAYS)],
        on,
        vec![piece("ink", end, END_ON..2.0)],
    ]
    .concat()
}

/// A cylinder whose axis is the last of three coordinates; its faces are drawn up to a share of z that points at the reader.
fn cylinder(
    radius: f64,
    half: f64,
    to: impl Fn(f64, f64, f64) -> Vector,
    below: f64,
) -> Vec<Piece> {
    let end = |side: f64| -> Vec<Vector> {
        let on = |i: i32| {
            let angle = side * TAU * f64::from(i) / 28.0;
            to(radius * angle.cos(), radius * angle.sin(), side * half)
        };
        (0..28).map(on).collect()
    };
    let ends = [end(-1.0), end(1.0)];
    let faces = ends
        .clone()
        .map(|e| piece("joint", Form::Face(e), 0.0..below));
    [
        vec![joint_piece(Form::Hull(ends.concat(), 0.0))],
        faces.to_vec(),
    ]
    .concat()
}

fn cuboid(half: [f64; 3]) -> Vec<Piece> {
    let sides = (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]);
    let face = |(axis, side): (usize, f64)| {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(s, t)| {
            let mut v = [0.0; 3];
            v[axis] = side * half[axis];
            v[a] = s * half[a];
            v[b] = side * t * half[b];
            v
        });
        joint_piece(Form::Face(corners.to_vec()))
    };
    sides.map(face).collect()
}

fn plate(half: f64, z: f64) -> Piece {
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)];
    let corners = corners.map(|(x, y)| [half * x, half * y, z]);
    joint_piece(Form::Hull(corners.to_vec(), 0.0))
}

/// A nut on a rod, with its thread; from its end the thread is a spiral.
fn screw() -> Vec<Piece> {
    let thread = (0..=40).map(|i| {
        let t = f64::from(i) / 20.0 - 1.0;
        let turn = 2.5 * PI * t;
        [3.4 * turn.sin(), -3.4 * turn.cos(), 8.0 * t]
    });
    let spiral = (0..=36).map(|i| {
        let t = f64::from(i) / 36.0;
        let turn = 2.0 * TAU * t;
        [4.4 * t * turn.cos(), 4.4 * t * turn.sin()]
    });
    let spiral = Form::Paper(spiral.collect(), false);
    [
        vec![line("line", rod(16.0), ALWAYS)],
        cylinder(BUSH, 9.0, |x, y, z| [x, y, z], FACE_ON),
        vec![
            line("line", thread.collect(), 0.0..SPIRAL),
            piece("line", spiral, SPIRAL..2.0),
        ],
    ]
    .concat()
}

/// What holds a ball: an arc round most of it.
fn socket() -> Piece {
    let arc = (0..=20).map(|i| {
        let angle = PI * (-0.2 + 1.4 * f64::from(i) / 20.0);
        [9.5 * angle.cos(), 9.5 * angle.sin()]
    });
    piece("line", Form::Paper(arc.collect(), false), ALWAYS)
}

/// A square with its diagonals.
fn crossed_square(h: f64) -> Vec<Piece> {
    let corners = vec![[-h, -h], [h, -h], [h, h], [-h, h]];
    let across = |d: f64| {
        let ends = vec![[-h, -h * d], [h, h * d]];
        piece("line", Form::Paper(ends, false), ALWAYS)
    };
    vec![
        joint_piece(Form::Paper(corners, true)),
        across(1.0),
        across(-1.0),
    ]
}

/// The cross of a universal joint: its two axes, z and x, as arms that end in pins.
fn cross(reach: f64) -> Vec<Piece> {
    let ends = |n: usize| {
        [-1.0, 1.0].map(|side| {
            let mut v = [0.0; 3];
            v[n] = side * reach;
            v
        })
    };
    let arm = |n: usize, seen| piece("joint", Form::Hull(ends(n).to_vec(), ARM), seen);
    // From its end the middle stays empty: a dot there is the end of a rod that it slides on.
    let pins = [(0, ALWAYS), (2, 0.0..END_ON)]
        .into_iter()
        .flat_map(|(n, seen)| ends(n).map(|at| piece("ink", Form::Ball(at, 1.3), seen.clone())));
    let middle = ball(ARM - 0.7, "blank");
    let arms = [arm(0, ALWAYS), arm(2, 0.0..END_ON), middle];
    arms.into_iter().chain(pins).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::place::projection;
    use crate::geom::vector::{X, Y, Z};

    #[test]
    fn each_type_of_joint_has_a_symbol_of_its_own_from_every_side() {
        let types = JointType::NAMED;
        let along_z = projection::along_z();
        for pose in [
            PaperPose::of_axes([X, Y, Z], &along_z),
            PaperPose::of_axes([Y, Z, X], &along_z),
            PaperPose::of_axes([Z, X, Y], &along_z),
            PaperPose::of_axes([X, Y, Z], &projection::aslant()),
        ] {
            let drawn = types.each_ref().map(|t| {
                let mut shapes = symbol(t, &pose, "", 1.0);
                // what is a point on paper is not seen
                shapes.retain(|s| {
                    let r = extent(std::slice::from_ref(s));
                    (r.right - r.left).max(r.bottom - r.top) > 2.5
                });
                format!("{shapes:?}")
            });
            for (i, one) in drawn.iter().enumerate() {
                assert!(!drawn[..i].contains(one), "{} as another", types[i]);
            }
        }
    }
}
