//! What a file says of a two-lever gripper and what it must hold. SI units, angles in radians.

use crate::model::JointId;

/// Where the levers' pivots are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pivots {
    /// At the distance that makes every diameter a nominal one: the gripper is adjusted to the part.
    Nominal,
    /// At this signed distance from the axis; the levers turn to fit the part. `[m]`
    Fixed(f64),
    /// At the distance that makes [`GripSpec::diameter`] the nominal one; the levers turn to fit other parts.
    FixedForDiameter,
}

/// How the drive reaches the levers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeverDrive {
    /// One drive turns both levers by the same angle through gears or a slider, which pass any difference on.
    Coupled,
    /// Both levers are given the same moment, as from one pressure in two cylinders.
    Equal,
    /// Each lever has a drive of its own that gives any moment from zero to the stated one.
    Independent,
}

/// Mass of the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PartMass {
    /// The same for every diameter. `[kg]`
    Constant(f64),
    /// A solid cylinder.
    Cylinder {
        /// `[kg/m³]`
        density: f64,
        /// `[m]`
        length: f64,
    },
}

impl PartMass {
    /// Length of the part, where it is stated. `[m]`
    #[must_use]
    pub fn part_length(&self) -> Option<f64> {
        match *self {
            PartMass::Constant(_) => None,
            PartMass::Cylinder { length, .. } => Some(length),
        }
    }

    /// Mass of a part of this diameter. `[kg]`
    #[must_use]
    pub fn of(&self, diameter: f64) -> f64 {
        match *self {
            PartMass::Constant(mass) => mass,
            PartMass::Cylinder { density, length } => {
                density * std::f64::consts::PI / 4.0 * diameter * diameter * length
            }
        }
    }
}

/// A vector, or all vectors of one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Toward {
    /// This vector. `[m/s²]`
    Fixed([f64; 3]),
    /// This size in any direction. `[m/s²]`
    Any(f64),
}

/// A step of a motion: how the gripper is held and carried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionStep {
    /// `[s]`, where stated.
    pub time: Option<f64>,
    /// The part; the nominal one where not stated. `[m]`
    pub diameter: Option<f64>,
    /// Gravity in the gripper's axes; the file's where not stated. `[m/s²]`
    pub gravity: Option<[f64; 3]>,
    /// Of the gripper in its axes. `[m/s²]`
    pub acceleration: [f64; 3],
}

/// What the gripper must hold.
#[derive(Debug, Clone, PartialEq)]
pub struct GripLoad {
    /// Mass of the part.
    pub mass: PartMass,
    /// Mass centre from the part's centre, where the faces are. `[m]`
    pub centre_of_mass: [f64; 3],
    /// Gravity in the gripper's axes.
    pub gravity: Toward,
    /// Accelerations of the gripper, one at a time, in its axes.
    pub accelerations: Vec<Toward>,
    /// Coefficient of friction between the part and the faces.
    pub friction: f64,
    /// The load is multiplied by this.
    pub safety: f64,
    /// How the drive reaches the levers.
    pub levers: LeverDrive,
}

/// How the drive's force becomes the levers' moments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transmission {
    /// Not stated.
    Unknown,
    /// Travel of the drive per radian of the levers. `[m]`
    Arm(f64),
    /// Read off the mechanism: the joints the two levers turn in.
    Joints([JointId; 2]),
}

/// A gripper of two mirrored levers with V-prisms. `[Pavlenko & Godunko 2010]`
#[derive(Debug, Clone, PartialEq)]
pub struct GripSpec {
    /// L. `[m]`
    pub lever_length: f64,
    /// α. `[rad]`
    pub prism_angle: f64,
    /// γ. `[rad]`
    pub mounting_angle: f64,
    /// Nominal diameter D. `[m]`
    pub diameter: f64,
    /// Diameters to be held, ascending. `[m]`
    pub diameters: Vec<f64>,
    /// Where the pivots are.
    pub pivots: Pivots,
    /// Length of the faces, where stated. `[m]`
    pub face_length: Option<f64>,
    /// Width of the levers. `[m]`
    pub lever_width: f64,
    /// Whether the levers lie in planes of their own and may cross.
    pub may_cross: bool,
    /// What must be held, where stated.
    pub load: Option<GripLoad>,
    /// How the drive works on the levers.
    pub transmission: Transmission,
    /// The joints of the mechanism that stand for the contacts: upper far, upper near, lower far, lower near; where they are
    /// named, the contact forces load the jaws in the states that have these joints.
    pub contacts: Option<[JointId; 4]>,
}
