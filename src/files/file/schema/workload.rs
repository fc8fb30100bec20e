//! `[workload]` with `[workload.drive]`, and the inertia of links.

use crate::model::loads::Tolerances;
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
    /// Faces of the contacts with a clamped part, for one-sided contacts in `ozols statics`.
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

/// Accuracy of the joints: a named fit, or a position and an angle. A tolerance is three standard deviations of each axis.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AccuracyEntry {
    /// "fine" (0.15 mm, 0.5°; default), "medium" (0.3 mm, 0.5°) or "coarse" (0.8 mm, 1°) of ISO 2768 for 30 to 120 mm.
    #[schemars(extend("enum" = Tolerances::NAMES))]
    pub fit: Option<String>,
    /// Tolerance of the position, in the file's unit of length. Default: that of the fit.
    pub position: Option<Coordinate>,
    /// Tolerance of the direction: radians or "0.1deg". Default: that of the fit.
    pub angle: Option<Quantity>,
    /// Force in N that a person applies at each joint in assembly. Default: 50.
    pub hand_force: Option<Coordinate>,
    /// Joints with their own tolerances.
    pub joint: Vec<JointAccuracyEntry>,
}

/// Tolerances of one joint. The default is those of all joints.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointAccuracyEntry {
    /// The joint.
    pub joint: String,
    /// Tolerance of the position, in the file's unit of length.
    pub position: Option<Coordinate>,
    /// Tolerance of the direction: radians or "0.1deg".
    pub angle: Option<Quantity>,
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

/// A number, or an exact expression in quotes: "sqrt(3)/2", "cos(36deg)", "tan(pi/8)", "1/3".
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a number, or an expression in quotes such as \"sqrt(3)/2\""
)]
pub enum Coordinate {
    /// A whole number.
    Integer(i64),
    /// A decimal, taken exactly as written.
    Decimal(f64),
    /// An expression.
    Expression(String),
}

impl Default for Coordinate {
    fn default() -> Coordinate {
        Coordinate::Integer(0)
    }
}

impl From<i64> for Coordinate {
    fn from(x: i64) -> Coordinate {
        Coordinate::Integer(x)
    }
}

impl From<f64> for Coordinate {
    fn from(x: f64) -> Coordinate {
        Coordinate::Decimal(x)
    }
}

impl From<&str> for Coordinate {
    fn from(x: &str) -> Coordinate {
        Coordinate::Expression(x.to_owned())
    }
}

/// A number, or a number with a unit in quotes: "360deg", "60rpm".
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a number, or a number with its unit in quotes such as \"360deg\""
)]
pub enum Quantity {
    /// A number in SI units, lengths in the file's unit.
    Number(f64),
    /// A number with a unit.
    Text(String),
}

/// One quantity or several.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number or a list of numbers")]
pub enum Quantities {
    /// One quantity.
    One(Quantity),
    /// Several quantities.
    Many(Vec<Quantity>),
}

/// Accuracy of the numbers of the file, instead of half a unit of their last digit. Expressions are always exact.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToleranceEntry {
    /// Uncertainty of points, pitches and leads, in the file's unit of length; 0 if they are exact.
    pub length: Option<Coordinate>,
    /// Uncertainty of axes and references, in radians; 0 if they are exact.
    pub direction: Option<Coordinate>,
}

/// One word or several.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "expected a word in quotes or a list of them")]
pub enum Words {
    /// One word.
    One(String),
    /// Several words.
    Many(Vec<String>),
}
