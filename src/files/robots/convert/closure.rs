//! The ways to close a loop, and a robot with one of its loops closed in another.

use crate::geom::rigid::{RigidMotion, perpendicular};
use crate::geom::vector::{Vector, Z, add, cross, length, scale, unit};
use crate::model::joint_type::JointType;
use crate::robots::description::parts::Robot;

/// A way to close a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoopClosure {
    /// As the file has it.
    AsGiven,
    /// A point of one link stays at a point of the other: 3 constraints.
    Connect,
    /// A point of one link stays on a line of the other: 2 constraints.
    Line,
    /// Two crossing axes: 4 constraints.
    Universal,
    /// A turn about an axis and a slide along it: 4 constraints.
    Cylinder,
    /// A turn about an axis: 5 constraints.
    Hinge,
    /// The same by two points on the axis: 6 constraints, one of which only repeats the others.
    TwoPoints,
    /// Rigid: 6 constraints.
    Weld,
}

impl LoopClosure {
    /// All, with the words for them, those that come first preferred.
    pub const ALL: [(&'static str, LoopClosure); 8] = [
        ("as-given", LoopClosure::AsGiven),
        ("connect", LoopClosure::Connect),
        ("universal", LoopClosure::Universal),
        ("cylinder", LoopClosure::Cylinder),
        ("hinge", LoopClosure::Hinge),
        ("line", LoopClosure::Line),
        ("weld", LoopClosure::Weld),
        ("two-points", LoopClosure::TwoPoints),
    ];

    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        let own = |(_, c): &&(&str, LoopClosure)| *c == self;
        LoopClosure::ALL.iter().find(own).map_or("", |c| c.0)
    }

    /// Whether it has an axis.
    pub(super) fn is_directed(self) -> bool {
        !matches!(
            self,
            LoopClosure::AsGiven | LoopClosure::Connect | LoopClosure::Weld
        )
    }

    fn joint_type(self) -> Option<JointType> {
        Some(match self {
            LoopClosure::AsGiven => return None,
            LoopClosure::Connect | LoopClosure::TwoPoints => JointType::Spherical,
            LoopClosure::Line => JointType::SphereInCylinder,
            LoopClosure::Universal => JointType::Universal,
            LoopClosure::Cylinder => JointType::Cylindrical,
            LoopClosure::Hinge => JointType::Revolute,
            LoopClosure::Weld => JointType::Fixed,
        })
    }
}

/// Two directions that are the same line, in radians.
const ALIKE: f64 = 1e-6;
/// Most directions that are tried at a loop.
const MOST: usize = 4;

/// Directions in the world that the axis of a closure may have: its own, and those of the joints beside it.
pub(super) fn directions(robot: &Robot, places: &[RigidMotion], j: usize) -> Vec<Vector> {
    // What is fixed together is one body.
    let mut body: Vec<usize> = (0..robot.links.len()).collect();
    for p in robot
        .joints
        .iter()
        .filter(|p| !p.closes && p.joint_type == JointType::Fixed)
    {
        let [a, b] = p.links.map(|l| body[l]);
        body.iter_mut().filter(|x| **x == b).for_each(|x| *x = a);
    }
    let ends = robot.joints[j].links.map(|l| body[l]);
    let touches = |k: &usize| {
        robot.joints[*k]
            .links
            .iter()
            .any(|l| ends.contains(&body[*l]))
    };
    let others = (0..robot.joints.len()).filter(|&k| k != j).filter(touches);
    let mut out: Vec<Vector> = Vec::new();
    for k in std::iter::once(j).chain(others) {
        let p = &robot.joints[k];
        if p.joint_type == JointType::Spherical || p.joint_type.freedoms().len() > 2 {
            continue;
        }
        let frame = places[p.links[0]].then(&p.sides[0]);
        for &f in p.joint_type.freedoms() {
            let d = unit(frame.direction(p.direction(f)));
            let known = |o: &Vector| length(cross(*o, d)) < ALIKE;
            if !out.iter().any(known) && out.len() < MOST {
                out.push(d);
            }
        }
    }
    if out.is_empty() {
        out.push(Z);
    }
    out
}

/// The robot, in its pose, with a loop closed in another way about an axis in the world; `far` is how far apart two points are.
pub(super) fn applied(
    robot: &Robot,
    places: &[RigidMotion],
    j: usize,
    closure: LoopClosure,
    [axis, second]: [Vector; 2],
    far: f64,
) -> Robot {
    let mut out = robot.clone();
    let Some(kind) = closure.joint_type() else {
        return out;
    };
    let p = &robot.joints[j];
    let at = places[p.links[0]].then(&p.sides[0]).translation;
    let put = |off: f64| {
        let frame = RigidMotion {
            translation: add(at, scale(unit(axis), off)),
            ..RigidMotion::z_to(axis)
        };
        let mut part = p.clone();
        part.sides = p.links.map(|l| places[l].inverse().then(&frame));
        part.values = vec![0.0; kind.freedoms().len()];
        part.joint_type = kind.clone();
        let x = cross(cross(axis, second), axis);
        let x = if length(x) > ALIKE {
            x
        } else {
            perpendicular(axis)
        };
        (part.axis, part.second) = (Z, frame.inverse().direction(unit(x)));
        (part.pitch, part.zero, part.limits) = (0.0, 0.0, None);
        part.closes = true;
        part
    };
    if closure == LoopClosure::TwoPoints {
        let mut other = put(-far);
        other.id = format!("{}~2", p.id);
        out.joints[j] = put(far);
        out.joints.push(other);
    } else {
        out.joints[j] = put(0.0);
    }
    out
}
