//! `[workload]` and the inertia of links.

use super::drive::DriveEntry;
use super::grip::GripEntry;
use super::number::{Coordinate, Quantities, Quantity, Words};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Loads and drive, for `ozols statics`; a gripper, for `ozols grip`.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorkloadEntry {
    /// Acceleration of gravity in m/s², such as [0, -9.81, 0]; none where left out.
    #[serde(default)]
    pub gravity: Option<[Coordinate; 3]>,
    /// Forces from outside.
    #[serde(default)]
    pub force: Vec<ForceEntry>,
    /// Moments from outside.
    #[serde(default)]
    pub moment: Vec<MomentEntry>,
    /// Faces of the contacts with a clamped object, for `ozols statics --unilateral`.
    #[serde(default)]
    pub contact: Vec<ContactEntry>,
    /// Stiffness of joints by the name of their type, `default` for the rest: `[workload.stiffness.spherical]`.
    #[serde(default)]
    pub stiffness: BTreeMap<String, StiffnessEntry>,
    /// Joints made or mounted askew.
    #[serde(default)]
    pub misalignment: Vec<MisalignmentEntry>,
    /// Speed of the drive in rad/s, or the file's length unit per second; "60rpm" and "30deg/s" will do too. One for
    /// each drive where there are several.
    #[serde(default)]
    pub drive_speed: Option<Quantities>,
    /// The cycle.
    #[serde(default)]
    pub stroke: Option<StrokeEntry>,
    /// Clamping levers and what they must hold, for `ozols grip`.
    #[serde(default)]
    pub grip: Option<GripEntry>,
    /// Two discs on a torsion bar, for `ozols drive`.
    #[serde(default)]
    pub drive: Option<DriveEntry>,
}

/// A force of fixed direction at a point that moves with a link.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceEntry {
    /// The link it acts on.
    pub link: String,
    /// Its point at the pose of the file.
    pub point: [Coordinate; 3],
    /// The force in N.
    pub force: [Coordinate; 3],
    /// It acts from this position of the first drive, in each turn: radians or "90deg", or the file's length unit.
    #[serde(default)]
    pub from: Option<Quantity>,
    /// And up to this one.
    #[serde(default)]
    pub to: Option<Quantity>,
    /// State or states it acts in, such as "free" for a force that stands for a part; all where left out.
    #[serde(default)]
    pub state: Option<Words>,
}

/// A range of the first drive's position, counted from the pose of the file.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrokeEntry {
    /// Where it begins: radians or "90deg", or the file's length unit.
    pub from: Quantity,
    /// Where it ends.
    pub to: Quantity,
    /// Number of equal steps.
    pub steps: i64,
}

/// A moment of fixed direction on a link.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MomentEntry {
    /// The link it acts on.
    pub link: String,
    /// The moment in N·m.
    pub moment: [Coordinate; 3],
    /// State or states it acts in; all where left out.
    #[serde(default)]
    pub state: Option<Words>,
}

/// The face of a contact between a jaw and an object.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactEntry {
    /// The joint.
    pub joint: String,
    /// Coefficient of friction; as much friction as it takes where left out.
    #[serde(default)]
    pub friction: Option<Coordinate>,
    /// Radius of the face, within which the pressure has its centre; anywhere where left out.
    #[serde(default)]
    pub radius: Option<Coordinate>,
}

/// Stiffness of a joint where it does not move.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StiffnessEntry {
    /// In N/m.
    pub linear: f64,
    /// In N·m/rad.
    pub angular: f64,
}

/// A joint whose second link is turned or shifted against its first where nothing strains it: an angle or a length.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MisalignmentEntry {
    /// The joint.
    pub joint: String,
    /// Small turn: radians or "0.1deg".
    #[serde(default)]
    pub angle: Option<Quantity>,
    /// Small shift, in the file's unit of length.
    #[serde(default)]
    pub length: Option<f64>,
    /// About or along x, y or z of the joint's own frame.
    pub axis: String,
}

/// Inertia about the mass centre: a number for the plane, three about the axes, or six of a tensor: xx, yy, zz, xy, yz, zx.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected one number, or a list of 3 or 6 numbers"
)]
pub enum InertiaEntry {
    /// About the plane's normal.
    Plane(f64),
    /// xx, yy, zz, and perhaps xy, yz, zx.
    List(#[schemars(length(min = 3, max = 6))] Vec<f64>),
}
