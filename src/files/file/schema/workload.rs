//! `[workload]` with `[workload.drive]`, and the inertia of links.

use super::grip::GripEntry;
use super::number::{Coordinate, Quantities, Quantity, Words};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Loads and drive, for `ozols statics`; a gripper, for `ozols grip`.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WorkloadEntry {
    /// Acceleration of gravity in m/s², such as [0, -9.81, 0]; none where left out.
    pub gravity: Option<[Coordinate; 3]>,
    /// Forces from outside.
    pub force: Vec<ForceEntry>,
    /// Moments from outside.
    pub moment: Vec<MomentEntry>,
    /// Faces of the contacts with a clamped object, for `ozols statics --unilateral`.
    pub contact: Vec<ContactEntry>,
    /// Stiffness of joints by the name of their type, `default` for the rest: `[workload.stiffness.spherical]`.
    pub stiffness: BTreeMap<String, StiffnessEntry>,
    /// Joints made or mounted askew.
    pub misalignment: Vec<MisalignmentEntry>,
    /// Speed of the drive in rad/s, or the file's length unit per second; "60rpm" and "30deg/s" will do too. One for
    /// each drive where there are several.
    pub drive_speed: Option<Quantities>,
    /// The cycle.
    pub stroke: Option<StrokeEntry>,
    /// Clamping levers and what they must hold, for `ozols grip`.
    pub grip: Option<GripEntry>,
    /// Two discs on a torsion bar, for `ozols drive`.
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
    pub from: Option<Quantity>,
    /// And up to this one.
    pub to: Option<Quantity>,
    /// State or states it acts in, such as "free" for a force that stands for a part; all where left out.
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
    pub state: Option<Words>,
}

/// The face of a contact between a jaw and an object.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactEntry {
    /// The joint.
    pub joint: String,
    /// Coefficient of friction; as much friction as it takes where left out.
    pub friction: Option<Coordinate>,
    /// Radius of the face, within which the pressure has its centre; anywhere where left out.
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
    pub angle: Option<Quantity>,
    /// Small shift, in the file's unit of length.
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

/// Two discs on a torsion bar, for `ozols drive`. Lengths in the file's unit; angles in degrees, or as "120deg", "2.1rad",
/// "pi/2"; all else in SI units.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DriveEntry {
    /// 2 φ0, from one latched position to the next.
    pub swing_angle: Coordinate,
    /// τ in s, a whole oscillation: two swings.
    pub period: Option<Coordinate>,
    /// Time of one swing in s, in place of `period`.
    pub swing_time: Option<Coordinate>,
    /// I in kg·m², the largest inertia of a disc with its payload.
    pub inertia: Option<Coordinate>,
    /// Inertia in kg·m² of the bare disc, in place of `inertia`; with the payload.
    pub disc_inertia: Option<Coordinate>,
    /// The link whose mass and inertia are those of the bare disc, in place of `disc_inertia`; it turns on the frame.
    pub disc_link: Option<String>,
    /// Mass of the payload in kg, taken as a point.
    pub payload_mass: Option<Coordinate>,
    /// From the axis to the payload.
    pub payload_radius: Option<Coordinate>,
    /// Inertia of the second disc in kg·m² where it differs.
    pub second_inertia: Option<Coordinate>,
    /// G of the bar in Pa.
    pub shear_modulus: Coordinate,
    /// Allowable shear stress of the bar in Pa.
    pub allowable_stress: Coordinate,
    /// Length of the bar to begin with; it is lengthened until strong enough.
    pub torsion_length: Option<Coordinate>,
    /// Greatest length of the bar.
    pub max_length: Option<Coordinate>,
    /// Diameters that bars come in; any where left out.
    #[serde(default)]
    pub diameters: Vec<Coordinate>,
    /// Δφ, the angle missing after a swing without the cam, measured.
    pub missing_angle: Option<Coordinate>,
    /// Damping moment per speed in N·m·s/rad.
    pub viscous_damping: Option<Coordinate>,
    /// Moment of dry friction in N·m.
    pub friction_moment: Option<Coordinate>,
    /// S, stroke of the cam spring's end.
    pub spring_stroke: Option<Coordinate>,
    /// ψ0, deformation of the mounted spring over its stroke; 0 where left out.
    pub mounting_coefficient: Option<Coordinate>,
    /// η, mean efficiency of the cam; 1 where left out.
    pub cam_efficiency: Option<Coordinate>,
    /// From the disc's axis to the centre of the follower's roller where it is lifted; with `roller_radius` the cam's profile
    /// follows.
    pub cam_radius: Option<Coordinate>,
    /// Radius of the follower's roller.
    pub roller_radius: Option<Coordinate>,
    /// Work of the cam in a swing in J, in place of what friction takes by equation (12).
    pub feed_energy: Option<Coordinate>,
    /// Where the cam begins to push, from the middle of the swing; the middle where left out. It pushes up to the latch.
    pub feed_from: Option<Coordinate>,
    /// In place of `feed_energy` and `feed_from`, a push of several moments: where each piece begins, from the middle of the
    /// swing, and its moment in N·m, as in [[0, 0.5], [20, 0.3]]. The last lasts up to the latch.
    pub feed_moments: Option<Vec<[Coordinate; 2]>>,
    /// How far short of its groove a latch still catches a disc; 1 degree where left out.
    pub latch_capture: Option<Coordinate>,
    /// "stepwise" (the default): the discs take turns, and both step on the same way; "reversing": one disc goes to and fro.
    pub motion: Option<String>,
    /// Number of swings; 8 where left out.
    pub swings: Option<i64>,
    /// Dwell after each swing in s; none where left out.
    pub dwell: Option<Coordinate>,
    /// In place of `motion`, `swings` and `dwell`: steps such as ["1", "wait 0.3", "2"], a disc swinging or a dwell in s.
    pub programme: Option<Vec<String>>,
}
