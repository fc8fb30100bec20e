//! Faces of jaws as the forces they can exert on a part: at points of the face, each within its friction cone.
//!
//! Friction, the moment about the normal and the moment along the face all come from the same pressure, so they are
//! limited together. Friction that a face uses at its rim is not available again to resist a turn, or while the face is
//! tipped over an edge.

use crate::geom::vector::add_scaled;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::statics::reactions::contact::Contact;
use crate::statics::reactions::geometry::{Geometry, Six, wrench};
use std::f64::consts::TAU;

/// Number of points of the polygon that represents the rim of a round face. The polygon lies within the face, at most 2
/// % inside its rim.
pub(crate) const RIM: usize = 16;

/// Area in which the pressure of a face can act, with lengths in the geometry's size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PressureArea {
    /// A disc of this radius; unlimited if none is stated.
    Disc(Option<f64>),
    /// A line along x of the joint's frame, of this half length; unlimited if none is stated.
    Line(Option<f64>),
    /// A point.
    Point,
}

/// A face of a jaw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JawFace {
    /// The joint that represents it.
    pub joint: JointId,
    /// 1 if the part is the second link of the joint, -1 if it is the first.
    pub second: f64,
    /// 1 if z of the joint's frame points to the part, otherwise -1.
    pub towards: f64,
    /// Coefficient of friction. `None` means as much friction as required.
    pub friction: Option<f64>,
    /// Area of its pressure.
    pub shape: PressureArea,
}

/// A pressing point: unit wrenches on the part, about the geometry's middle.
#[derive(Debug, Clone)]
pub(super) struct Press {
    /// Wrench along the normal.
    pub(super) normal: Six,
    /// Wrenches along the face.
    pub(super) along: [Six; 2],
}

impl JawFace {
    /// Creates the face of a contact, with the friction and the half length of a line that a grip states for it.
    #[must_use]
    pub fn new(m: &Mechanism, g: &Geometry, contact: &Contact, object: LinkId) -> JawFace {
        let joint = &m.joints[contact.joint];
        let second = if joint.links[1] == object { 1.0 } else { -1.0 };
        let grip = m.loads.grip.as_ref();
        let of_grip = grip.filter(|g| g.contacts.is_some_and(|c| c.contains(&contact.joint)));
        let load = of_grip.and_then(|g| g.load.as_ref());
        let half = load
            .and_then(|l| l.mass.part_length())
            .map(|l| l / 2.0 / g.size);
        let (shape, unstated) = match joint.joint_type {
            JointType::CylinderOnPlane => (PressureArea::Line(contact.radius.or(half)), Some(0.0)),
            JointType::SphereOnPlane => (PressureArea::Point, Some(0.0)),
            JointType::Fixed => (PressureArea::Disc(contact.radius), None),
            _ => (PressureArea::Disc(contact.radius), Some(0.0)),
        };
        JawFace {
            joint: contact.joint,
            second,
            towards: contact.push() * second,
            friction: contact.friction.or(load.map(|l| l.friction)).or(unstated),
            shape,
        }
    }

    /// Returns the face without friction.
    #[must_use]
    pub fn smooth(self) -> JawFace {
        JawFace {
            friction: Some(0.0),
            ..self
        }
    }

    /// Returns its points, and the wrenches that are unlimited if no size is stated.
    pub(super) fn presses(&self, g: &Geometry) -> (Vec<Press>, Vec<Six>) {
        let ([x, y, z], at) = (g.axes[self.joint], g.points[self.joint]);
        let normal = z.map(|c| c * self.towards);
        let force = |p, f| wrench(p, f, [0.0; 3]);
        let press = |p: [f64; 3]| Press {
            normal: force(p, normal),
            along: [force(p, x), force(p, y)],
        };
        let turn = |axis| wrench([0.0; 3], [0.0; 3], axis);
        let spin = (self.friction != Some(0.0)).then(|| turn(z));
        match self.shape {
            PressureArea::Point => (vec![press(at)], Vec::new()),
            PressureArea::Line(Some(half)) => {
                let ends = [half, -half].map(|h| press(add_scaled(at, h, x)));
                (ends.to_vec(), Vec::new())
            }
            PressureArea::Line(None) => {
                (vec![press(at)], spin.into_iter().chain([turn(y)]).collect())
            }
            PressureArea::Disc(Some(radius)) => {
                #[allow(clippy::cast_precision_loss, reason = "a count of points")]
                let rim = (0..RIM).map(|k| {
                    let (sin, cos) = (TAU * k as f64 / RIM as f64).sin_cos();
                    press(add_scaled(add_scaled(at, radius * cos, x), radius * sin, y))
                });
                (rim.collect(), Vec::new())
            }
            PressureArea::Disc(None) => {
                let free = spin.into_iter().chain([turn(x), turn(y)]);
                (vec![press(at)], free.collect())
            }
        }
    }

    /// Returns its extent from its point, if known.
    #[must_use]
    pub fn reach(&self) -> Option<f64> {
        match self.shape {
            PressureArea::Disc(r) | PressureArea::Line(r) => r,
            PressureArea::Point => None,
        }
    }
}
