//! A robot as described by a file: links, joints, loops, couplings, and their places in the text.
//!
//! The formats have in common: links, joints with a place on either side, named frames.

pub(in crate::robots) mod coupling;
pub(in crate::robots) mod digits;
pub(in crate::robots) mod kinematics;
pub(in crate::robots) mod loops;
pub(in crate::robots) mod origin;
pub(in crate::robots) mod physical;

use crate::file::problem::ImportError;
use crate::geom::rigid::{RigidMotion, perpendicular};
use crate::geom::vector::{Vector, X, Z, cross};
use crate::model::joint_type::{Freedom, JointType};
use crate::robots::warning::{Found, Read, Report, unknown_name};
use crate::robots::xml::element::Element;
use std::collections::{BTreeMap, BTreeSet};

/// A link and a place on it.
pub(crate) type End = (usize, RigidMotion);

/// The places of a joint on its two links.
type Sides = [RigidMotion; 2];

/// A joint between two links, or a constraint that closes a loop.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    /// Its name; made unique before it is written.
    pub(in crate::robots) id: String,
    /// Parent and child.
    pub(in crate::robots) links: [usize; 2],
    /// The joint's place on the parent and on the child.
    pub(in crate::robots) sides: [RigidMotion; 2],
    pub(in crate::robots) joint_type: JointType,
    /// Direction of z in the joint's own frame, of any length.
    pub(in crate::robots) axis: Vector,
    /// Direction of x in the joint's own frame.
    pub(in crate::robots) second: Vector,
    /// Translation per radian of a screw, in metres.
    pub(in crate::robots) pitch: f64,
    pub(in crate::robots) drive: bool,
    /// Whether an actuator moves it by a tendon, which others may share.
    pub(in crate::robots) pulled: bool,
    /// Whether it closes a loop according to the file; such joints join the tree last.
    pub(in crate::robots) closes: bool,
    /// Value of the one freedom in the pose drawn, subtracted from values given from outside.
    pub(in crate::robots) zero: f64,
    /// Displacement of each freedom.
    pub(in crate::robots) values: Vec<f64>,
    /// Limits of a joint of one freedom.
    pub(in crate::robots) limits: Option<(f64, f64)>,
    /// The element that defines it. `None` if a separate file does.
    pub(in crate::robots) element: Option<usize>,
    /// Distance between its two sides in its constrained directions, if the file places both: a length in the robot's unit, and radians.
    pub(in crate::robots) misfit: Option<[f64; 2]>,
}

impl Part {
    /// Returns the value and the limits of a joint of one freedom that is outside them after a motion by `moved`. `None` if it is within
    /// them or has no limits.
    pub(in crate::robots) fn exceeded_limits(&self, moved: f64) -> Option<[f64; 3]> {
        let (Some((low, high)), [value]) = (self.limits, &self.values[..]) else {
            return None;
        };
        // A joint is often at one of its limits.
        let (at, slack) = (value + moved, 1e-6 * (high - low).max(1e-3));
        (!(low - slack..=high + slack).contains(&at)).then_some([at, low, high])
    }

    /// Creates a joint at rest with the axis z.
    pub(crate) fn new(id: &str, links: [usize; 2], sides: Sides, joint_type: JointType) -> Part {
        Part {
            id: id.to_owned(),
            links,
            sides,
            values: vec![0.0; joint_type.freedoms().len()],
            joint_type,
            axis: Z,
            second: X,
            pitch: 0.0,
            zero: 0.0,
            drive: false,
            pulled: false,
            closes: false,
            limits: None,
            element: None,
            misfit: None,
        }
    }

    /// Sets the element of the joint.
    pub(crate) fn said_by(mut self, e: Element<'_>) -> Part {
        self.element = Some(e.id);
        self
    }

    /// Rotates the joint to another axis of its frame.
    pub(crate) fn set_axis(&mut self, axis: Vector) {
        self.axis = axis;
        self.second = perpendicular(axis);
    }

    /// Returns the direction of a freedom in the joint's own frame.
    pub(crate) fn direction(&self, freedom: Freedom) -> Vector {
        match freedom.axis() {
            0 => self.second,
            1 => cross(self.axis, self.second),
            _ => self.axis,
        }
    }
}

/// Returns the error for a joint or constraint that connects a link to itself.
pub(crate) fn same_link(e: Element<'_>) -> ImportError {
    e.unsupported_error("it connects a link to itself", "name two different links")
}

/// Returns a joint type with all six freedoms.
pub(crate) fn free_joint() -> JointType {
    use Freedom::{Rx, Ry, Rz, Tx, Ty, Tz};
    JointType::Custom(vec![Tx, Ty, Tz, Rx, Ry, Rz])
}

/// Returns the joint type of a word, if it is among those `known` in a format, which are separated by commas.
pub(crate) fn joint_of_word(word: &str, known: &str) -> Option<JointType> {
    if !known.split(", ").any(|k| k == word) {
        return None;
    }
    Some(match word {
        "revolute" | "continuous" | "hinge" => JointType::Revolute,
        "prismatic" | "slider" | "slide" => JointType::Prismatic,
        "cylindrical" => JointType::Cylindrical,
        "screw" => JointType::Helical,
        "universal" | "revolute2" => JointType::Universal,
        "spherical" | "ball" | "point" | "3d" => JointType::Spherical,
        "planar" => JointType::Planar,
        "fixed" | "weld" | "6d" => JointType::Fixed,
        "floating" | "free" => free_joint(),
        _ => return None,
    })
}

/// Rate of one joint over that of another.
#[derive(Debug, Clone)]
pub(crate) struct Ratio {
    /// Names of the joint that leads and the one that follows.
    pub(in crate::robots) joints: [String; 2],
    /// Rate of the follower over that of the leader, in radians and metres, with the leader at its reference.
    pub(in crate::robots) ratio: f64,
    /// Coefficients of the second to fourth power of the leader's value, if the follower's value is a polynomial of it.
    pub(in crate::robots) higher: [f64; 3],
    /// The element that defines it, in words.
    pub(in crate::robots) element: String,
    /// The index of that element.
    pub(in crate::robots) said_by: usize,
    /// Whether gears make it, according to the file.
    pub(in crate::robots) gear: bool,
}

impl Ratio {
    /// Returns the ratio of an element that couples a leading joint and a following one.
    pub(crate) fn new(joints: [&str; 2], ratio: f64, e: Element<'_>) -> Ratio {
        Ratio {
            joints: joints.map(str::to_owned),
            ratio,
            higher: [0.0; 3],
            element: e.label(),
            said_by: e.id,
            gear: false,
        }
    }

    /// Returns the rate at a value of the leader: the derivative of the polynomial.
    pub(in crate::robots) fn rate_at(&self, value: f64) -> f64 {
        let [two, three, four] = self.higher;
        self.ratio + value * (2.0 * two + value * (3.0 * three + value * 4.0 * four))
    }
}

/// A robot as read.
#[derive(Debug, Clone, Default)]
pub(crate) struct Robot {
    pub(in crate::robots) name: String,
    /// Names of the links.
    pub(in crate::robots) links: Vec<String>,
    pub(in crate::robots) joints: Vec<Part>,
    /// Joints that move in a fixed ratio.
    pub(in crate::robots) couplings: Vec<Ratio>,
    /// The link that is the world, if the format has one.
    pub(in crate::robots) world: Option<usize>,
    /// Whether parts that no joint holds float in the world.
    pub(in crate::robots) floats: bool,
    /// Links with a shape or a site: parts that are more than kinematics.
    pub(in crate::robots) shown: BTreeSet<usize>,
    /// Named frames: the link they are fixed to and their place on it.
    pub(in crate::robots) frames: BTreeMap<String, (usize, RigidMotion)>,
    /// Places of links in the file, for links without another place.
    pub(in crate::robots) places: Vec<RigidMotion>,
    /// The symbol of the unit of its lengths: m or mm.
    pub(in crate::robots) unit: &'static str,
    /// The accuracy of places, in its unit and in radians, if it is better than the digits of its numbers.
    pub(in crate::robots) known_to: Option<[f64; 2]>,
    /// Whether a joint has freedoms that are valid at this pose only.
    pub(in crate::robots) here_only: bool,
    /// Whether it is an assembly of a CAD program. Its joints have one of a few types, and fixed joints of a loop are joints like others.
    /// Otherwise rigidly joined links are one body.
    pub(in crate::robots) assembly: bool,
    /// Joint types that a search may use instead of a joint.
    pub(in crate::robots) options: &'static [JointType],
    pub(in crate::robots) report: Report,
}

/// Joint types that a search may use instead of a joint, if a format has no list.
const OPTIONS: [JointType; 4] = [
    JointType::Revolute,
    JointType::Cylindrical,
    JointType::Universal,
    JointType::Spherical,
];

impl Robot {
    pub(crate) fn new(name: &str) -> Robot {
        Robot {
            name: name.to_owned(),
            options: &OPTIONS,
            unit: "m",
            ..Robot::default()
        }
    }

    /// Adds a link; its frame gets its name.
    pub(crate) fn add_link(&mut self, name: &str, place: RigidMotion) -> usize {
        let l = self.links.len();
        self.links.push(name.to_owned());
        self.places.push(place);
        self.frames
            .insert(name.to_owned(), (l, RigidMotion::IDENTITY));
        l
    }

    /// Adds the joint of an element that closes a loop between a place on one link and a place on another.
    ///
    /// # Errors
    /// Returns an error if both places are on the same link.
    pub(crate) fn close_loop(
        &mut self,
        e: Element<'_>,
        id: &str,
        ends: [End; 2],
        kind: JointType,
    ) -> Read<&mut Part> {
        let links = ends.map(|end| end.0);
        if links[0] == links[1] {
            return Err(same_link(e));
        }
        let mut part = Part::new(id, links, ends.map(|end| end.1), kind).said_by(e);
        part.closes = true;
        let at = self.joints.len();
        self.joints.push(part);
        Ok(&mut self.joints[at])
    }

    /// Returns the link that an element names.
    ///
    /// # Errors
    /// Returns an error that lists the links if there is none of that name.
    pub(crate) fn link_named(&self, element: &str, name: &str) -> Found<usize> {
        let found = self.links.iter().position(|l| l == name);
        found.ok_or_else(|| unknown_name(element, ["link", "links"], name, &self.links))
    }

    /// Returns the joint that an element names.
    ///
    /// # Errors
    /// Returns an error that lists the joints if there is none of that name.
    pub(crate) fn joint_named(&self, element: &str, name: &str) -> Found<usize> {
        let ids = self.joints.iter().map(|j| &j.id);
        let found = ids.clone().position(|id| id == name);
        found.ok_or_else(|| unknown_name(element, ["joint", "joints"], name, ids))
    }

    /// Returns the link or frame of a name.
    pub(crate) fn frame(&self, name: &str) -> Option<End> {
        self.frames.get(name).copied()
    }
}
