//! Specification of a two-lever gripper and its loads in a file. SI units, angles in radians.

use crate::model::JointId;

/// Positions of the levers' pivots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pivots {
    /// At the distance that makes every diameter a nominal one: the gripper is adjusted to the part.
    Nominal,
    /// At this signed distance from the axis; the levers turn to fit the part. `[m]`
    Fixed(f64),
    /// At the distance that makes [`GripSpec::diameter`] the nominal one; the levers turn to fit other parts.
    FixedForDiameter,
}

/// Connection between the drive and the levers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeverDrive {
    /// One drive turns both levers by the same angle through gears or a slider, which transmit any difference.
    Coupled,
    /// Both levers get the same moment, as from one pressure in two cylinders.
    Equal,
    /// Each lever has a separate drive that gives any moment from zero to the stated one.
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
    /// Returns the mass of a part of this diameter. `[kg]`
    ///
    /// # Examples
    /// ```
    /// use ozols::model::grip::PartMass;
    /// let steel = PartMass::Cylinder { density: 7850.0, length: 0.1 };
    /// assert!((steel.for_diameter(0.05) - 1.541).abs() < 1e-3); // kg
    /// ```
    #[must_use]
    pub fn for_diameter(&self, diameter: f64) -> f64 {
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

/// A step of a motion: orientation and acceleration of the gripper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionStep {
    /// `[s]`, if stated.
    pub time: Option<f64>,
    /// Diameter of the part. The default is the nominal one. `[m]`
    pub diameter: Option<f64>,
    /// Gravity in the gripper's axes. The default is that of the file. `[m/s²]`
    pub gravity: Option<[f64; 3]>,
    /// Acceleration of the gripper in its axes. `[m/s²]`
    pub acceleration: [f64; 3],
}

/// The load that the gripper must hold.
#[derive(Debug, Clone, PartialEq)]
pub struct GripLoad {
    /// Mass of the part.
    pub mass: PartMass,
    /// Mass centre relative to the part's centre, at the faces. `[m]`
    pub centre_of_mass: [f64; 3],
    /// Gravity in the gripper's axes.
    pub gravity: Toward,
    /// Accelerations of the gripper, one at a time, in its axes.
    pub accelerations: Vec<Toward>,
    /// Coefficient of friction between the part and the faces.
    pub friction: f64,
    /// Factor on the load.
    pub safety: f64,
    /// Connection between the drive and the levers.
    pub levers: LeverDrive,
}

/// Relation between the drive's force and the levers' moments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transmission {
    /// Not stated.
    Unknown,
    /// Travel of the drive per radian of the levers. `[m]`
    Arm(f64),
    /// Derived from the mechanism, with the joints of the two levers.
    Joints([JointId; 2]),
}

/// A gripper of two mirrored levers with V-blocks. `[Pavlenko & Godunko 2010]`
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
    /// Diameters to hold, ascending. `[m]`
    pub diameters: Vec<f64>,
    /// Positions of the pivots.
    pub pivots: Pivots,
    /// Length of the faces, if stated. `[m]`
    pub face_length: Option<f64>,
    /// Width of the levers. `[m]`
    pub lever_width: f64,
    /// Whether the levers lie in separate planes and may cross.
    pub may_cross: bool,
    /// The load to hold, if stated.
    pub load: Option<GripLoad>,
    /// Effect of the drive on the levers.
    pub transmission: Transmission,
    /// The joints of the mechanism that represent the contacts: upper far, upper near, lower far, lower near. If they
    /// are named, the contact forces load the jaws in the states that have these joints.
    pub contacts: Option<[JointId; 4]>,
}
