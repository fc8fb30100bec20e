//! `[workload.grip]`.

use super::number::Coordinate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A gripper of two mirrored levers with V-prisms, for `ozols grip`. Lengths are in the file's unit; angles are in degrees, or
/// written as "120deg", "2.1rad", "2*pi/3". Axes: x along the gripper's axis of symmetry from the pivots to the part, y across
/// from the lower to the upper lever, z along the part.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GripEntry {
    /// Lever length L, from the pivot to the vertex of the prism.
    pub lever_length: Coordinate,
    /// Prism angle α, between the faces of the prism.
    pub prism_angle: Coordinate,
    /// Mounting angle γ, between the lever and the face nearer to the pivot.
    pub mounting_angle: Coordinate,
    /// Nominal diameter D of the part.
    pub diameter: Coordinate,
    /// Diameters to hold: a list, or { from, to, count }. Default: the nominal diameter.
    pub diameters: Option<Diameters>,
    /// "fixed" (default): the pivots stay where `diameter` is nominal, and the levers turn to fit other parts. "nominal": the
    /// pivots are placed for each diameter.
    pub pivots: Option<String>,
    /// Distance a from the pivots to the axis of symmetry, replacing the value that follows from `diameter`.
    pub pivot_distance: Option<Coordinate>,
    /// Length of the faces from the vertex. Contacts beyond it do not hold.
    pub face_length: Option<Coordinate>,
    /// Width of the levers, which must not touch each other. Default: 0.
    pub lever_width: Option<Coordinate>,
    /// True if the levers lie in separate planes and may cross (required if l2 > l1). Default: false.
    #[serde(default)]
    pub levers_cross: bool,
    /// Mass of the part in kg.
    pub mass: Option<Coordinate>,
    /// Density of the part in kg/m³, instead of its mass; needs `part_length`.
    pub density: Option<Coordinate>,
    /// Length of the part; needs `density`.
    pub part_length: Option<Coordinate>,
    /// Centre of mass of the part, relative to the middle of the jaws. Default: [0, 0, 0].
    pub centre_of_mass: Option<[Coordinate; 3]>,
    /// Acceleration of gravity in m/s² in the gripper's axes, or "any" if the robot turns the gripper. Default: [0, -9.80665, 0].
    pub gravity: Option<Gravity>,
    /// Accelerations of the gripper in m/s² in its own axes, each a separate load case.
    #[serde(default)]
    pub accelerations: Vec<[Coordinate; 3]>,
    /// Acceleration of the gripper in m/s² in any direction.
    pub any_acceleration: Option<Coordinate>,
    /// Coefficient of friction between part and faces.
    pub friction: Option<Coordinate>,
    /// Safety factor on the load. Default: 1.
    pub safety: Option<Coordinate>,
    /// "coupled" (default): one drive turns both levers by the same angle. "equal": the same moment on both. "independent": one
    /// drive each.
    pub levers: Option<String>,
    /// Travel of the drive per radian of the levers. It converts drive moments to a drive force.
    pub drive_arm: Option<Coordinate>,
    /// Joints that the two levers turn in, upper and lower, instead of `drive_arm`. The travel follows from the mechanism, whose
    /// pose in the file is that of the nominal diameter.
    pub lever_joints: Option<[String; 2]>,
    /// Joints of the part that represent its contacts: upper far, upper near, lower far, lower near. In the states that have
    /// them, `ozols statics` and `ozols search` load the jaws with the contact forces found here. Needs `lever_joints`.
    pub contacts: Option<[String; 4]>,
}

/// Diameters: a list, or equal steps.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a list of diameters, or a table such as { from = 30, to = 60, count = 7 }"
)]
pub enum Diameters {
    /// A list of diameters.
    List(Vec<Coordinate>),
    /// Equal steps.
    Steps(DiameterSteps),
}

/// Equal steps of diameter.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiameterSteps {
    /// Smallest diameter.
    pub from: Coordinate,
    /// Largest diameter.
    pub to: Coordinate,
    /// Number of diameters.
    pub count: i64,
}

/// A vector, or "any".
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a vector in m/s² such as [0, -9.81, 0], or \"any\""
)]
pub enum Gravity {
    /// A vector.
    Vector([Coordinate; 3]),
    /// "any".
    Word(String),
}
