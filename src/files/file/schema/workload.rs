//! `[workload]` with `[workload.drive]`, and the inertia of links.

use super::grip::GripEntry;
use super::number::{Coordinate, Quantities, Quantity, Words};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Loads and drive, for `ozols statics`, and a gripper, for `ozols grip`.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WorkloadEntry {
    /// Acceleration of gravity in m/s², such as [0, -9.81, 0]. Default: none.
    pub gravity: Option<[Coordinate; 3]>,
    /// External forces.
    pub force: Vec<ForceEntry>,
    /// External moments.
    pub moment: Vec<MomentEntry>,
    /// Faces of the contacts with a clamped part, for `ozols statics --unilateral`.
    pub contact: Vec<ContactEntry>,
    /// Stiffness of joints by the name of their type, `default` for all others: `[workload.stiffness.spherical]`.
    pub stiffness: BTreeMap<String, StiffnessEntry>,
    /// Joints that are made or mounted misaligned.
    pub misalignment: Vec<MisalignmentEntry>,
    /// Speed of the drive in rad/s, or the file's length unit per second; "60rpm" and "30deg/s" work, too. With several drives,
    /// one speed per drive.
    pub drive_speed: Option<Quantities>,
    /// Range of the first drive over the cycle.
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
    /// Its point in the drawn pose.
    pub point: [Coordinate; 3],
    /// The force in N.
    pub force: [Coordinate; 3],
    /// Position of the first drive at which it begins to act, in each turn: radians or "90deg", or the file's length unit.
    pub from: Option<Quantity>,
    /// Position of the first drive at which it stops acting.
    pub to: Option<Quantity>,
    /// State or states in which it acts, such as "free" for a force that represents a part. Default: all.
    pub state: Option<Words>,
}

/// A range of the first drive, relative to the drawn pose.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrokeEntry {
    /// Start: radians or "90deg", or the file's length unit.
    pub from: Quantity,
    /// End.
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
    /// State or states in which it acts. Default: all.
    pub state: Option<Words>,
}

/// The face of a contact between a jaw and a clamped part.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactEntry {
    /// The joint.
    pub joint: String,
    /// Coefficient of friction. Default: as much friction as needed.
    pub friction: Option<Coordinate>,
    /// Radius of the face, within which the centre of pressure lies. Default: anywhere.
    pub radius: Option<Coordinate>,
}

/// Stiffness of a joint in the directions in which it does not move.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StiffnessEntry {
    /// Linear stiffness in N/m.
    pub linear: f64,
    /// Angular stiffness in N·m/rad.
    pub angular: f64,
}

/// A joint whose second link is rotated or shifted relative to its first in the unstrained state, by an angle or a length.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MisalignmentEntry {
    /// The joint.
    pub joint: String,
    /// Small rotation: radians or "0.1deg".
    pub angle: Option<Quantity>,
    /// Small shift, in the file's unit of length.
    pub length: Option<f64>,
    /// Axis of the rotation or shift: x, y or z of the joint's own frame.
    pub axis: String,
}

/// Inertia about the centre of mass: a number for the plane, three about the axes, or six of a tensor: xx, yy, zz, xy, yz, zx.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected one number, or a list of 3 or 6 numbers"
)]
pub enum InertiaEntry {
    /// One number, about the plane's normal.
    Plane(f64),
    /// xx, yy, zz, and optionally xy, yz, zx.
    List(#[schemars(length(min = 3, max = 6))] Vec<f64>),
}

/// Two discs on a torsion bar, for `ozols drive`. Lengths are in the file's unit; angles are in degrees, or written as "120deg",
/// "2.1rad", "pi/2"; all other quantities are in SI units.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DriveEntry {
    /// Swing angle 2 φ0, from one latched position to the next.
    pub swing_angle: Coordinate,
    /// Period τ in s, a full oscillation of two swings.
    pub period: Option<Coordinate>,
    /// Time of one swing in s, instead of `period`.
    pub swing_time: Option<Coordinate>,
    /// Inertia I in kg·m², the largest of a disc with its payload.
    pub inertia: Option<Coordinate>,
    /// Inertia in kg·m² of the bare disc, instead of `inertia`; needs the payload.
    pub disc_inertia: Option<Coordinate>,
    /// Link with the mass and inertia of the bare disc, instead of `disc_inertia`; it turns on the frame.
    pub disc_link: Option<String>,
    /// Mass of the payload in kg, taken as a point.
    pub payload_mass: Option<Coordinate>,
    /// Distance from the axis to the payload.
    pub payload_radius: Option<Coordinate>,
    /// Inertia of the second disc in kg·m², if it differs.
    pub second_inertia: Option<Coordinate>,
    /// Shear modulus G of the bar in Pa.
    pub shear_modulus: Coordinate,
    /// Allowable shear stress of the bar in Pa.
    pub allowable_stress: Coordinate,
    /// Initial length of the bar. It is increased until the bar is strong enough.
    pub torsion_length: Option<Coordinate>,
    /// Maximum length of the bar.
    pub max_length: Option<Coordinate>,
    /// Available diameters of bars. Default: any.
    #[serde(default)]
    pub diameters: Vec<Coordinate>,
    /// Angle Δφ missing after a swing without the cam, measured.
    pub missing_angle: Option<Coordinate>,
    /// Viscous damping in N·m·s/rad.
    pub viscous_damping: Option<Coordinate>,
    /// Moment of dry friction in N·m.
    pub friction_moment: Option<Coordinate>,
    /// Stroke S of the end of the cam spring.
    pub spring_stroke: Option<Coordinate>,
    /// Mounting coefficient ψ0: deformation of the mounted spring divided by its stroke. Default: 0.
    pub mounting_coefficient: Option<Coordinate>,
    /// Mean efficiency η of the cam. Default: 1.
    pub cam_efficiency: Option<Coordinate>,
    /// Work of the cam per swing in J, replacing the friction loss of equation (12).
    pub feed_energy: Option<Coordinate>,
    /// Angle from the middle of the swing at which the cam begins to push. Default: the middle. It pushes up to the latch.
    pub feed_from: Option<Coordinate>,
    /// Maximum distance from its groove at which a latch still catches a disc. Default: 1 degree.
    pub latch_capture: Option<Coordinate>,
    /// "stepwise" (default): the discs take turns, and both step in the same direction. "reversing": one disc moves back and
    /// forth.
    pub motion: Option<String>,
    /// Number of swings. Default: 8.
    pub swings: Option<i64>,
    /// Dwell after each swing, in s. Default: none.
    pub dwell: Option<Coordinate>,
    /// Steps such as ["1", "wait 0.3", "2"], instead of `motion`, `swings` and `dwell`: a swing of a disc, or a dwell in s.
    pub programme: Option<Vec<String>>,
}
