//! Whether a joint is the image of another under a reflection or rotation of space, and its deviation.

use crate::closure::twist::{FrameValues, MotionSpace, joint_twists};
use crate::format::brief;
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::vector::{Vector, cross, dot, length, real};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Frame, Mechanism, Mode};

/// Position of a joint, in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spot {
    /// Its point.
    pub point: Vector,
    /// Its axis.
    pub axis: Vector,
}

impl Spot {
    /// Returns the position of a joint's frame.
    #[must_use]
    pub(crate) fn of(frame: &Frame) -> Spot {
        Spot {
            point: real(&frame.point),
            axis: real(&frame.axis),
        }
    }

    /// Returns the positions of all joints.
    pub(crate) fn of_joints(mechanism: &Mechanism) -> Vec<Spot> {
        let joints = mechanism.joint_ids();
        joints
            .map(|j| Spot::of(&mechanism.joints[j].frame))
            .collect()
    }
}

/// A joint type at a position, which determines the allowed motions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedType<'a> {
    /// Its frame.
    pub frame: &'a Frame,
    /// The type.
    pub joint_type: &'a JointType,
}

/// Deviation of the image of a joint from the joint it is paired with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// Distance of their points, or of their axes if the joint is the same all along its axis. In the file's unit.
    pub distance: f64,
    /// Angle between their axes, in radians.
    pub angle: f64,
}

impl Miss {
    /// Computes the deviation of a joint from the new position of its point and axis.
    fn new(image: Spot, of: &JointType, to: Spot) -> Miss {
        let own = to.axis;
        let off = [0, 1, 2].map(|i| image.point[i] - to.point[i]);
        let sine = length(cross(image.axis, own));
        let angle = match of {
            JointType::Spherical | JointType::Fixed => 0.0,
            _ => sine.atan2(dot(image.axis, own).abs()),
        };
        let distance = match of {
            JointType::Prismatic => 0.0,
            JointType::Revolute | JointType::Cylindrical | JointType::Helical => {
                length(cross(off, own)) / length(own)
            }
            _ => length(off),
        };
        Miss { distance, angle }
    }

    /// Returns distance and angle combined into one number for comparisons.
    pub(super) fn size(&self) -> f64 {
        self.distance + self.angle
    }

    /// Describes the deviation, such as "2.062 cm and 0.5°"; `unit` is that of the file.
    #[must_use]
    pub fn words(&self, unit: &str) -> String {
        let number = |x: f64| {
            if x < 1e-3 {
                format!("{x:.3e}")
            } else {
                brief(x)
            }
        };
        let distance = format!("{} {unit}", number(self.distance));
        match self.angle.to_degrees() {
            0.0 => distance,
            angle => format!("{distance} and {}°", number(angle)),
        }
    }
}

/// A map of space to itself that maps a mechanism to itself.
pub(crate) trait Carrier {
    /// Returns the image of a joint, in numbers.
    fn image(&self, spot: Spot) -> Spot;

    /// Returns the map of space in exact numbers, or `None` if lengths change.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    fn map(&self, exact: &ExactField) -> Result<Option<Map>, ExactError>;

    /// Returns the deviation of the image of a joint of a type from a position.
    #[must_use]
    fn miss(&self, from: Spot, of: &JointType, to: Spot) -> Miss {
        Miss::new(self.image(from), of, to)
    }

    /// Returns true if the image of a joint allows exactly the motions of another.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    fn carries(
        &self,
        exact: &ExactField,
        mode: &Mode,
        from: PlacedType<'_>,
        to: PlacedType<'_>,
    ) -> Result<bool, ExactError> {
        match self.map(exact)? {
            Some(map) => map.carries(exact, mode, from, to),
            None => Ok(false),
        }
    }
}

/// Map of space: x maps to `linear`·x + `shift`, and lengths are preserved.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Map {
    /// Images of x, y and z.
    pub(super) linear: [[Residue; 3]; 3],
    /// Image of the origin.
    pub(super) shift: [Residue; 3],
    /// Whether the map reverses orientation.
    pub(super) reflects: bool,
}

impl Map {
    /// Creates the map that acts on directions as `linear` does.
    pub(super) fn new(
        f: Field,
        linear: impl Fn([Residue; 3]) -> [Residue; 3],
        shift: [Residue; 3],
        reflects: bool,
    ) -> Map {
        let unit = |i: usize| [0, 1, 2].map(|j| if i == j { f.one() } else { f.zero() });
        Map {
            linear: [0, 1, 2].map(|i| linear(unit(i))),
            shift,
            reflects,
        }
    }

    fn direction(&self, f: Field, v: [Residue; 3]) -> [Residue; 3] {
        [0, 1, 2].map(|i| {
            let columns = self.linear.iter().zip(v);
            f.sum_of_products(columns.map(|(c, x)| (c[i], x)))
        })
    }

    fn carries(
        &self,
        exact: &ExactField,
        mode: &Mode,
        from: PlacedType<'_>,
        to: PlacedType<'_>,
    ) -> Result<bool, ExactError> {
        let f = exact.field();
        // A turn about u is a turn about -u in a mirror. The body point at the origin is the image of that at the
        // shift.
        let image = |[w0, w1, w2, v0, v1, v2]: [Residue; 6]| {
            let turned = self.direction(f, [w0, w1, w2]);
            let w = if self.reflects {
                turned.map(|x| f.neg(x))
            } else {
                turned
            };
            let arm = exact.cross(self.shift, w);
            let v = self.direction(f, [v0, v1, v2]);
            let at = |i: usize| f.add(v[i], arm[i]);
            [w[0], w[1], w[2], at(0), at(1), at(2)]
        };
        let space = MotionSpace::new(exact, mode)?;
        let freedoms = from.joint_type.freedoms();
        let values = FrameValues::new(exact, from.frame)?;
        let (mut images, mut own) = (Echelon::new(f), Echelon::new(f));
        for (_, twist) in values.motions(exact, &space, freedoms) {
            match space.components(exact, &image(twist)) {
                Some(t) => images.insert(&t),
                None => return Ok(false),
            };
        }
        for (_, t) in joint_twists(exact, &space, to.frame, to.joint_type)? {
            own.insert(&t);
        }
        Ok(images.reduced() == own.reduced())
    }
}
