//! Contacts of a clamped part with their actual behaviour: faces that push, hold by friction, and never pull.
//!
//! The equations treat a contact as a joint, which pulls as well as pushes. [`find_contacts`] determines which joints are
//! faces and in which direction they push. [`Contact::contact_force`] gives the force that a solution requires of one, and
//! whether a face can provide it.

use crate::geom::vector::{add_scaled, dot, sub};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Parts, Role};
use crate::statics::drop_rounding;
use crate::statics::reactions::geometry::{Geometry, Six, shift_wrench};
use crate::statics::reactions::unsolved::Unsolved;
use serde::Serialize;

/// Treatment of contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contacts {
    /// As the joints in the file, which may pull.
    AsJoints,
    /// As faces, which push. Friction stays within its cone and the pressure within the face, if these are stated.
    Pushing,
}

/// A face of a jaw on a clamped part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The joint; z of its frame is the face's normal.
    pub joint: JointId,
    /// Factor that turns z of the joint's reaction into a push on the clamped part.
    push: f64,
    /// Coefficient of friction, if stated.
    pub friction: Option<f64>,
    /// Radius of the face over the geometry's size, if stated.
    pub radius: Option<f64>,
}

/// Requirement of a solution on a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touch {
    /// A force that the face can provide, as far as its limits are stated.
    Pushes,
    /// No force.
    Idle,
    /// A pulling force.
    Pulls,
    /// More friction than its pressure allows.
    Slips,
    /// Pressure outside the face.
    Tilts,
}

/// The force of a face on the clamped part.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactForce {
    /// The joint.
    #[serde(skip)]
    pub joint: JointId,
    /// Normal force, negative if it pulls `[N]`.
    pub normal: f64,
    /// Force along the face `[N]`.
    #[serde(rename = "along_face")]
    pub along: f64,
    /// Moment along the face, from an offset of the centre of pressure `[N·m]`.
    pub tilting: f64,
    /// Coefficient of friction, if stated.
    pub friction: Option<f64>,
    /// Radius of the face `[m]`, if stated.
    pub radius: Option<f64>,
    /// Whether a face can provide this force.
    #[serde(skip)]
    pub touch: Touch,
}

/// Fraction of the largest reaction below which forces count as zero.
const NOTHING: f64 = 1e-7;

/// Returns the clamped part on which a joint is a face, if it is one.
#[must_use]
pub fn object_at(m: &Parts, joint: JointId) -> Option<LinkId> {
    let joint = &m.joints[joint];
    let face = matches!(
        joint.joint_type,
        JointType::Fixed
            | JointType::Planar
            | JointType::CylinderOnPlane
            | JointType::SphereOnPlane
    );
    let objects: Vec<LinkId> = joint
        .links
        .into_iter()
        .filter(|&l| m.links[l].role == Role::Object)
        .collect();
    match objects[..] {
        [object] if face => Some(object),
        _ => None,
    }
}

/// Returns the faces of a state. A face pushes towards the clamped part: the side with the middle of all its contacts,
/// or otherwise with its mass centre. If neither decides, it is the side away from the jaw's other joints.
///
/// # Errors
/// Returns [`Unsolved::Side`] if none of these decides.
pub fn find_contacts(m: &Mechanism, geometry: &Geometry) -> Result<Vec<Contact>, Unsolved> {
    let faces = geometry
        .joints
        .iter()
        .filter_map(|&j| Some((j, object_at(m, j)?)));
    let one = |(joint, object): (JointId, LinkId)| {
        let at_object = |j: &&JointId| m.joints[**j].links.contains(&object);
        let jaw = m.joints[joint].links.into_iter().find(|&l| l != object);
        let at_jaw =
            |j: &&JointId| **j != joint && jaw.is_some_and(|l| m.joints[**j].links.contains(&l));
        let (point, normal) = (geometry.points[joint], geometry.axes[joint][2]);
        let along = |p: [f64; 3]| dot(normal, sub(p, point));
        let middle = |of: &dyn Fn(&&JointId) -> bool| {
            let all: Vec<JointId> = geometry.joints.iter().filter(of).copied().collect();
            #[allow(clippy::cast_precision_loss, reason = "a count of joints")]
            let share = 1.0 / all.len().max(1) as f64;
            let sum = all
                .iter()
                .fold([0.0; 3], |s, &j| add_scaled(s, share, geometry.points[j]));
            if all.is_empty() { 0.0 } else { along(sum) }
        };
        let centre = m.links[object].mass.as_ref().map_or(0.0, |x| {
            along(geometry.of_file([0, 1, 2].map(|i| x.centre[i].to_f64())))
        });
        let sides = [middle(&at_object), centre, -middle(&at_jaw)];
        let side = sides
            .into_iter()
            .find(|s| s.abs() > 1e-6)
            .ok_or_else(|| Unsolved::Side {
                joint: m.joints[joint].id.clone(),
                object: m.links[object].id.clone(),
            })?;
        let second = m.joints[joint].links[1] == object;
        let face = m.loads.faces.iter().find(|f| f.joint == joint);
        Ok(Contact {
            joint,
            push: side.signum() * if second { 1.0 } else { -1.0 },
            friction: face.and_then(|f| f.friction),
            radius: face
                .and_then(|f| f.radius)
                .map(|r| r * geometry.metres / geometry.size),
        })
    };
    faces.map(one).collect()
}

impl ContactForce {
    /// Returns the force with 0 for values of at most `rounding` `[N]`, with moments divided by the `size`.
    pub(crate) fn drop_rounding(self, rounding: f64, size: f64) -> ContactForce {
        ContactForce {
            normal: drop_rounding(rounding, self.normal),
            along: drop_rounding(rounding, self.along),
            tilting: drop_rounding(rounding * size, self.tilting),
            ..self
        }
    }
}

impl Contact {
    /// Returns (moments; forces) at the contact along x, y, z of its frame. A positive z is a push, and x and y are up
    /// to one sign.
    pub(crate) fn contact_wrench(&self, geometry: &Geometry, wrenches: &[Six]) -> Six {
        let w = shift_wrench(&wrenches[self.joint], geometry.points[self.joint]);
        let axes = geometry.axes[self.joint];
        let along = |v: [f64; 3]| axes.map(|a| dot(a, v) * self.push);
        let ([a, b, c], [d, e, f]) = (along([w[0], w[1], w[2]]), along([w[3], w[4], w[5]]));
        [a, b, c, d, e, f]
    }

    /// Returns the requirement of a solution on the contact.
    #[must_use]
    pub fn contact_force(&self, geometry: &Geometry, wrenches: &[Six]) -> ContactForce {
        let w = self.contact_wrench(geometry, wrenches);
        let all = geometry
            .joints
            .iter()
            .flat_map(|&j| shift_wrench(&wrenches[j], geometry.points[j]));
        let least = NOTHING * all.fold(0.0, |a: f64, x| a.max(x.abs()));
        let (normal, along, tilting) = (w[5], w[3].hypot(w[4]), w[0].hypot(w[1]));
        let beyond =
            |value: f64, limit: Option<f64>| limit.is_some_and(|l| value > l * normal + least);
        let turn = w[2].abs();
        let rubbing = along.hypot(self.friction_arm().map_or(0.0, |arm| turn / arm));
        let twisted = self.friction.zip(self.friction_arm()).zip(self.radius);
        let turns = twisted.is_some_and(|((friction, arm), radius)| {
            turn * radius > friction * arm * (radius * normal - tilting) + least
        });
        let touch = if w.iter().all(|x| x.abs() <= least) {
            Touch::Idle
        } else if normal < -least {
            Touch::Pulls
        } else if beyond(tilting, self.radius) {
            Touch::Tilts
        } else if beyond(rubbing, self.friction) || turns {
            Touch::Slips
        } else {
            Touch::Pushes
        };
        ContactForce {
            joint: self.joint,
            normal,
            along,
            tilting: tilting * geometry.size,
            friction: self.friction,
            radius: self.radius.map(|r| r * geometry.size),
            touch,
        }
    }

    /// Returns the arm at which friction resists a moment about the normal if nothing else loads the face: 2/3 r, that
    /// of uniform pressure on a round face.
    ///
    /// With a force along the face, the two lie on an ellipse [Howe & Cutkosky 1996]. If the centre of pressure is
    /// offset by e, the pressure is uniform on the round face of radius r - e about it. Then 2/3 μ (r N - M) is left
    /// for a tipping moment M.
    pub(crate) fn friction_arm(&self) -> Option<f64> {
        self.friction?;
        Some(2.0 / 3.0 * self.radius?)
    }
}
