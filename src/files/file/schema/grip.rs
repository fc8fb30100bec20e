//! `[workload.grip]`.

use super::number::Coordinate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A gripper of two mirrored levers with V-prisms, for `ozols grip`. Lengths in the file's unit; angles in degrees, or as
/// "120deg", "2.1rad", "2*pi/3". Axes: x along the gripper's axis of symmetry from the pivots to the part, y across from the lower to the upper lever, z
/// along the part.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GripEntry {
    /// L, from the pivot to the vertex of the prism.
    pub lever_length: Coordinate,
    /// α, between the faces of the prism.
    pub prism_angle: Coordinate,
    /// γ, between the lever and the face nearer to the pivot.
    pub mounting_angle: Coordinate,
    /// Nominal diameter D of the part.
    pub diameter: Coordinate,
    /// Diameters to be held: a list, or { from, to, count }; the nominal one where left out.
    pub diameters: Option<Diameters>,
    /// "fixed" (the default): the pivots stay where `diameter` is nominal, the levers turn to fit other parts; "nominal": the
    /// pivots are set anew for each diameter.
    pub pivots: Option<String>,
    /// a, from the pivots to the axis of symmetry, in place of the one that follows from `diameter`.
    pub pivot_distance: Option<Coordinate>,
    /// Length of the faces from the vertex; contacts beyond it do not hold.
    pub face_length: Option<Coordinate>,
    /// Width of the levers, which must keep clear of each other; 0 where left out.
    pub lever_width: Option<Coordinate>,
    /// Whether the levers lie in planes of their own and may cross, as they do where l2 > l1; false where left out.
    #[serde(default)]
    pub levers_cross: bool,
    /// Mass of the part in kg.
    pub mass: Option<Coordinate>,
    /// Density of the part in kg/m³, in place of its mass; with `part_length`.
    pub density: Option<Coordinate>,
    /// Length of the part, with `density`.
    pub part_length: Option<Coordinate>,
    /// Mass centre of the part from the middle of the jaws; [0, 0, 0] where left out.
    pub centre_of_mass: Option<[Coordinate; 3]>,
    /// Acceleration of gravity in m/s² in the gripper's axes, or "any" where the robot turns the gripper about;
    /// [0, -9.80665, 0] where left out.
    pub gravity: Option<Gravity>,
    /// Accelerations of the gripper in m/s² in its own axes, each a case of its own.
    #[serde(default)]
    pub accelerations: Vec<[Coordinate; 3]>,
    /// Acceleration of the gripper in m/s² in any direction.
    pub any_acceleration: Option<Coordinate>,
    /// Coefficient of friction between part and faces.
    pub friction: Option<Coordinate>,
    /// Factor on the load; 1 where left out.
    pub safety: Option<Coordinate>,
    /// "coupled" (the default): one drive turns both levers by the same angle; "equal": the same moment on both;
    /// "independent": a drive each.
    pub levers: Option<String>,
    /// Travel of the drive per radian of the levers, which makes drive moments a drive force.
    pub drive_arm: Option<Coordinate>,
    /// The joints that the two levers turn in, upper and lower, in place of `drive_arm`: the travel follows from the
    /// mechanism, whose pose in the file is that of the nominal diameter.
    pub lever_joints: Option<[String; 2]>,
    /// The joints of the part that stand for its contacts: upper far, upper near, lower far, lower near. In the states that
    /// have them, `ozols statics` and `ozols search` load the jaws with the contact forces found here. Needs `lever_joints`.
    pub contacts: Option<[String; 4]>,
}

/// Diameters: a list, or equal steps.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a list of diameters, or a table such as { from = 30, to = 60, count = 7 }"
)]
pub enum Diameters {
    /// These.
    List(Vec<Coordinate>),
    /// Equal steps.
    Steps(DiameterSteps),
}

/// Equal steps of diameter.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiameterSteps {
    /// The least.
    pub from: Coordinate,
    /// The greatest.
    pub to: Coordinate,
    /// How many.
    pub count: i64,
}

/// A vector, or "any".
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a vector in m/s² such as [0, -9.81, 0], or \"any\""
)]
pub enum Gravity {
    /// This one.
    Vector([Coordinate; 3]),
    /// "any".
    Word(String),
}
