//! What links and joints carry besides kinematics, whatever the format: weights, shapes by reference, dynamics of joints,
//! actuators, named frames.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::Vector;
use crate::robots::convert::lost::Lost;
use std::collections::BTreeMap;

/// Attributes as the format read has them, for a file written in the same format.
pub(crate) type Words = Vec<(String, String)>;

/// Mass in kg, and the tensor in kg·m².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Weight {
    pub(crate) mass: f64,
    /// Place of the centre, with the axes that the tensor is given in.
    pub(crate) place: RigidMotion,
    /// xx, yy, zz, xy, xz, yz about the centre.
    pub(crate) tensor: [f64; 6],
}

/// What a shape is. Lengths are in metres.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Solid {
    /// Whole edges.
    Box(Vector),
    Sphere(f64),
    /// Radius, and whole length along z.
    Cylinder(f64, f64),
    /// Radius, and length along z without the round ends.
    Capsule(f64, f64),
    /// Half axes.
    Ellipsoid(Vector),
    /// Whole edges along x and y; zero where it has no end. z is the normal.
    Plane([f64; 2]),
    /// A file, as it is named, and scales of the axes.
    Mesh(String, Vector),
}

/// What a shape is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    Seen,
    Touched,
    Both,
}

impl Use {
    /// The elements that URDF and SDF have for it.
    pub(crate) fn tags(self) -> &'static [&'static str] {
        match self {
            Use::Seen => &["visual"],
            Use::Touched => &["collision"],
            Use::Both => &["visual", "collision"],
        }
    }
}

/// A shape on a link.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LinkShape {
    pub(crate) name: Option<String>,
    pub(crate) solid: Solid,
    pub(crate) place: RigidMotion,
    pub(crate) colour: Option<[f64; 4]>,
    pub(crate) use_: Use,
    /// Words of MJCF that say how it touches.
    pub(crate) words: Words,
}

/// What resists or drives a joint, in N, m, rad and s; zero, and endless where it is a bound, where the file says nothing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dynamics {
    pub(crate) damping: f64,
    /// Dry friction.
    pub(crate) friction: f64,
    pub(crate) armature: f64,
    pub(crate) stiffness: f64,
    /// The value at which the spring is at rest.
    pub(crate) rest: f64,
    pub(crate) effort: f64,
    pub(crate) velocity: f64,
    /// Whether limits that stand there do not hold.
    pub(crate) unlimited: bool,
    /// Words of MJCF for its solver.
    pub(crate) words: Words,
}

impl Default for Dynamics {
    fn default() -> Self {
        Dynamics {
            damping: 0.0,
            friction: 0.0,
            armature: 0.0,
            stiffness: 0.0,
            rest: 0.0,
            effort: f64::INFINITY,
            velocity: f64::INFINITY,
            unlimited: false,
            words: Words::new(),
        }
    }
}

/// What an actuator does with its input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Command {
    Effort,
    Position,
    Velocity,
}

/// An actuator of a joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Actuator {
    pub(crate) name: Option<String>,
    /// The robot's joint.
    pub(crate) joint: usize,
    pub(crate) command: Command,
    pub(crate) gear: f64,
    /// Its tag and words in MJCF, where it was read from that.
    pub(crate) tag: Option<String>,
    pub(crate) words: Words,
}

/// What a robot carries; lists of links and joints are by their places in the robot.
#[derive(Debug, Clone, Default)]
pub(crate) struct Payload {
    pub(crate) weights: BTreeMap<usize, Weight>,
    pub(crate) shapes: BTreeMap<usize, Vec<LinkShape>>,
    /// By joint, for each of its freedoms, or once for all.
    pub(crate) dynamics: BTreeMap<usize, Vec<Dynamics>>,
    pub(crate) actuators: Vec<Actuator>,
    /// By element of a coupling: the follower's value where the leader's is zero, and MJCF's words.
    pub(crate) offsets: BTreeMap<usize, f64>,
    pub(crate) couplings: BTreeMap<usize, Words>,
    /// By joint that closes a loop: MJCF's words for its solver.
    pub(crate) closures: BTreeMap<usize, Words>,
    /// Sites and frames: name, link and place.
    pub(crate) frames: Vec<(String, usize, RigidMotion)>,
    /// MJCF's words for the whole model.
    pub(crate) option: Words,
    pub(crate) lost: Lost,
}

impl Payload {
    /// The dynamics of a freedom of a joint.
    pub(crate) fn of(&self, joint: usize, freedom: usize) -> Dynamics {
        let all = self.dynamics.get(&joint).map_or(&[][..], Vec::as_slice);
        all.get(freedom)
            .or(all.first())
            .cloned()
            .unwrap_or_default()
    }

    /// Takes in a shape; one that is seen and another alike that is touched are one.
    pub(crate) fn shape(&mut self, link: usize, shape: LinkShape) {
        let all = self.shapes.entry(link).or_default();
        let alike = |s: &&mut LinkShape| {
            s.solid == shape.solid
                && s.place == shape.place
                && matches!((s.use_, shape.use_), (Use::Seen, Use::Touched))
        };
        match all.iter_mut().find(alike) {
            Some(same) => same.use_ = Use::Both,
            None => all.push(shape),
        }
    }
}
