//! The mechanism file, with one schema for TOML and JSON.

mod ranking;
mod workload;

pub use crate::file::schema::ranking::{JointTypeEntry, LimitEntry, RankingEntry, TermEntry};
pub use crate::file::schema::workload::Words;
pub use crate::file::schema::workload::{AccuracyEntry, JointAccuracyEntry, ToleranceEntry};
pub use crate::file::schema::workload::{
    ContactEntry, DriveEntry, ForceEntry, InertiaEntry, MisalignmentEntry, MomentEntry,
    StiffnessEntry, StrokeEntry, WorkloadEntry,
};
pub use crate::file::schema::workload::{Coordinate, Quantities, Quantity};
pub use crate::file::schema::workload::{DiameterSteps, Diameters, Gravity, GripEntry};
use crate::format::join_or;
use crate::model::joint_type::JointType;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A mechanism: links, joints, and the changes that a search may make.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MechanismFile {
    /// Short name, such as "four-bar".
    pub name: String,
    /// Short description, one or two sentences.
    #[serde(default)]
    pub description: String,
    /// Publications of the mechanism and its figures.
    #[serde(default)]
    pub sources: Vec<String>,
    /// Assumptions and omissions of a conversion from another format, a sentence each. The figures are those of the file as read.
    #[serde(default)]
    pub assumed: Vec<String>,
    /// Unit of all lengths: m (default), mm, cm, um or in.
    pub length_unit: Option<String>,
    /// "spatial" (default, 6 equations per loop) or "planar" (3 equations per loop).
    pub mode: Option<String>,
    /// Normal of the plane of motion in planar mode. Default: z.
    pub plane_normal: Option<[Coordinate; 3]>,
    /// Named numbers for expressions: `[parameter]` with `height = 40`, and `point = [0, "2*height", 0]`.
    #[serde(default)]
    pub parameter: BTreeMap<String, Coordinate>,
    /// Accuracy of the numbers. Default: half a unit of their last digit.
    pub tolerance: Option<ToleranceEntry>,
    /// The rigid bodies, each in a table. Exactly one is the frame, and at least one an output.
    #[serde(default)]
    pub link: Vec<LinkEntry>,
    /// The joints, each in a table.
    #[serde(default)]
    pub joint: Vec<JointEntry>,
    /// Joints that move in a fixed ratio: gears, belts, racks, mimic joints.
    #[serde(default)]
    pub coupling: Vec<CouplingEntry>,
    /// A basis of loops, if a particular one is required. Default: the shortest loops.
    #[serde(default)]
    pub contour: Vec<ContourEntry>,
    /// Points of interest on links. Drawings show them and their paths over a stroke.
    #[serde(default)]
    pub point: Vec<PointEntry>,
    /// Options of the search.
    #[serde(default)]
    pub search: SearchEntry,
    /// Loads and drive.
    #[serde(default)]
    pub workload: WorkloadEntry,
    /// Accuracy of the joints as made and mounted, for the misfit in `ozols statics` and in rankings. The accuracy of
    /// the file's numbers is `tolerance`.
    pub tolerances: Option<AccuracyEntry>,
    /// Ranking of variants under the workload. Default: by cost only.
    pub ranking: Option<RankingEntry>,
    /// Capacity of joint types, replacing the built-in catalogue: `[joint_types.spherical]`.
    #[serde(default)]
    pub joint_types: BTreeMap<String, JointTypeEntry>,
    /// Known figures. `ozols check` compares them with the analysis.
    #[serde(default)]
    pub expected: Vec<ExpectedEntry>,
    /// Claims of publications about this mechanism, true or false. The command for the topic prints them.
    #[serde(default)]
    pub claim: Vec<ClaimEntry>,
}

/// A rigid body.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinkEntry {
    /// Name, unique among links.
    pub id: String,
    /// "frame" (ground), "output" or "object" (clamped part). Omit it for other links.
    pub role: Option<String>,
    /// Mass in kg.
    pub mass: Option<f64>,
    /// Centre of mass in the drawn pose.
    pub centre: Option<[Coordinate; 3]>,
    /// Inertia about the centre of mass in kg·m²: one number about the normal of the plane, or 3 or 6 numbers in space.
    pub inertia: Option<InertiaEntry>,
}

/// A joint between two links.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointEntry {
    /// Name, unique among joints.
    pub id: String,
    /// The two links that it connects.
    pub links: [String; 2],
    /// Joint type, one of those of [`JointType`].
    #[schemars(description = format!("Type: {}.", join_or(JointType::all_words())))]
    #[schemars(extend("enum" = joint_words()))]
    #[serde(rename = "type")]
    pub kind: String,
    /// Freedoms of a custom joint: rx, ry, rz, tx, ty, tz, screw.
    pub freedoms: Option<Vec<String>>,
    /// Origin of the joint's frame. Each coordinate is a number, or an exact expression in quotes such as "sqrt(3)/2", "cos(36deg)", "1/3".
    pub point: [Coordinate; 3],
    /// Direction of z (joint axis), of any length. Default for spherical and fixed joints: z.
    pub axis: Option<[Coordinate; 3]>,
    /// Direction that defines x. Default: the first of the global x, y, z that is not parallel to the axis.
    pub reference: Option<[Coordinate; 3]>,
    /// Lead of a helical joint: translation per turn.
    pub lead: Option<Coordinate>,
    /// Pitch of a helical joint: translation per radian. Use it instead of the lead; it may contain pi: "5/(2*pi)".
    pub pitch: Option<Coordinate>,
    /// Uncertainty of the point, in the file's unit of length; 0 if it is exact.
    pub tolerance: Option<Coordinate>,
    /// True if this joint is driven, or the driven freedom, such as "tz", if the joint has several. A search does not change a
    /// driven joint unless it has its own options.
    #[serde(default)]
    pub drive: DriveWord,
    /// State or states in which the joint is present. Default: all.
    pub state: Option<Words>,
    /// Joint types that a search may put here, replacing the `[search]` list.
    pub options: Option<Vec<OptionEntry>>,
    /// Names of options that a search must not put here.
    #[serde(default)]
    pub forbid: Vec<String>,
    /// Joints that may be inserted in series here: true for those of `[search]`, or a list.
    pub unloading: Option<Unloading>,
}

/// Drive of a joint: false, true, or the driven freedom.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected true, false or the freedom that is driven, such as \"tz\""
)]
pub enum DriveWord {
    /// True: its only freedom is driven, or the one that contributes most to the motion of the outputs.
    Driven(bool),
    /// The driven freedom: rx, ry, rz, tx, ty, tz, screw.
    Freedom(String),
}

impl Default for DriveWord {
    fn default() -> Self {
        DriveWord::Driven(false)
    }
}

/// Unloading joints that may be inserted at a joint: true, false, or a list.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected true, false or a list of joint options"
)]
pub enum Unloading {
    /// True: those of `[search]`.
    Allowed(bool),
    /// These options.
    List(Vec<OptionEntry>),
}

/// A joint option of a search: a type name or a table.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a joint type in quotes, or a table such as { type = \"universal\", reference = [0, 1, 0] } or { freedoms = [\"rz\", \"ry\"], name = \"V\" }"
)]
pub enum OptionEntry {
    /// A type name.
    Word(String),
    /// A table.
    Table(Box<OptionTable>),
}

impl OptionEntry {
    /// Returns the option as a table.
    pub(crate) fn as_table(&self) -> Cow<'_, OptionTable> {
        match self {
            OptionEntry::Table(table) => Cow::Borrowed(table),
            OptionEntry::Word(kind) => Cow::Owned(OptionTable {
                kind: Some(kind.clone()),
                ..OptionTable::default()
            }),
        }
    }
}

/// A joint option as a table.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OptionTable {
    /// Joint type. Default: custom, if freedoms are given.
    #[serde(rename = "type")]
    pub kind: Option<String>,
    /// Freedoms of a custom joint.
    pub freedoms: Option<Vec<String>>,
    /// Origin of the frame. Default: that of the joint.
    pub point: Option<[Coordinate; 3]>,
    /// Direction of z. Default: that of the joint.
    pub axis: Option<[Coordinate; 3]>,
    /// Direction that defines x. Default: that of the joint. If this is parallel to the option's axis: the first of the global x,
    /// y, z that is not parallel to it.
    pub reference: Option<[Coordinate; 3]>,
    /// Lead of a helical joint: translation per turn.
    pub lead: Option<Coordinate>,
    /// Pitch of a helical joint: translation per radian. Use it instead of the lead; it may contain pi: "5/(2*pi)".
    pub pitch: Option<Coordinate>,
    /// Name shown in results.
    pub name: Option<String>,
    /// Cost, replacing the value of the table of costs.
    pub cost: Option<f64>,
    /// State that must be searched to allow this option. Default: allowed in every search.
    pub state: Option<String>,
}

/// A coupling: two joints that move in a fixed ratio.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CouplingEntry {
    /// The two joints. For a joint of several freedoms use "joint:freedom", such as "a:tz".
    pub joints: [String; 2],
    /// Velocity of the second joint divided by that of the first, in radians and the file's length unit. Examples: "-1/2" for
    /// gears of 20 and 40 teeth, the pitch radius for a pinion and its rack.
    pub ratio: Coordinate,
    /// True for gears or a rack and pinion, which are drawn as pitch circles. Other couplings are drawn as a line.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub gear: bool,
}

/// A closed loop (contour) of the basis, given by its joints in order.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourEntry {
    /// The joints.
    pub joints: Vec<String>,
}

/// A point of interest: the foot of a leg, the face of a jaw.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointEntry {
    /// Name, unique among points.
    pub id: String,
    /// The link that it is fixed to.
    pub link: String,
    /// Position in the drawn pose.
    pub point: [Coordinate; 3],
    /// Uncertainty of the point, in the file's unit of length; 0 if it is exact.
    pub tolerance: Option<Coordinate>,
}

/// Options of the search.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SearchEntry {
    /// Joint types for all joints without their own options, except drives, fixed joints and contacts.
    pub options: Vec<OptionEntry>,
    /// Unloading joints for joints with `unloading = true`.
    pub unloading: Vec<OptionEntry>,
    /// Links that must not gain a motion, in addition to the outputs.
    pub hold: Vec<String>,
    /// Pairs of joints that are mirror images.
    pub mirror: Vec<[String; 2]>,
    /// Joints that are mapped to each other by a rotation about one axis, each to the next and the last to the first: pairs for
    /// half a turn, or groups of three for a third. Cannot be combined with mirror images.
    pub turn: Vec<Vec<String>>,
    /// Redundant constraints that may be left within the mechanism; 0 by default.
    pub max_redundant: Option<u32>,
    /// Largest mobility W allowed; any by default.
    pub max_mobility: Option<i64>,
    /// Whether only variants that are their own mirror image are listed.
    pub symmetric: bool,
    /// Condition on the drives: "kept" (default: outputs and drives move together as now), "free" (only the outputs keep their
    /// motion) or "independent" (as many drives as degrees of freedom, and they determine the outputs).
    pub drives: Option<String>,
    /// Whether variants need to keep the motion in the drawn pose only, and not throughout.
    pub pose_only: bool,
    /// Costs by option or type name, and `change`, `driven` (extra cost of changing a driven joint), `link` and `harmful` (cost
    /// of each harmful redundant constraint that a searched state adds).
    pub costs: BTreeMap<String, f64>,
}

/// Known figures of a state.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExpectedEntry {
    /// State. Default: free.
    pub state: Option<String>,
    /// Instantaneous mobility W, including idle freedoms.
    pub mobility: Option<i64>,
    /// Finite (full-cycle) mobility. It is smaller than `mobility` at singular and shaky poses.
    pub finite_mobility: Option<i64>,
    /// Dimension of the output links' motion.
    pub working_mobility: Option<i64>,
    /// W minus the working mobility.
    pub local_mobility: Option<i64>,
    /// Number of redundant constraints σ of the whole state.
    pub redundant: Option<i64>,
    /// Number of redundant constraints that the state adds to the free one.
    pub external_redundant: Option<i64>,
    /// Publication or derivation.
    #[serde(default)]
    pub source: String,
}

/// A claim of a publication.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClaimEntry {
    /// Topic: "structure", "grip", "drive" or "statics".
    pub topic: String,
    /// Publication, and the place in it.
    pub source: String,
    /// The claim.
    pub says: String,
    /// Correct statement. Omit it if the claim holds.
    pub right: Option<String>,
    /// Part of a scanned text that a refutation rests on, if a misread letter could explain it.
    pub scan: Option<String>,
    /// Evidence for the correct statement.
    pub evidence: String,
}

impl MechanismFile {
    /// Returns the file as JSON, without values that equal their default.
    ///
    /// # Examples
    /// ```
    /// use ozols::file::write::mechanism_file;
    /// let json = mechanism_file(&ozols::built_in("four-bar")?).json();
    /// assert_eq!(json["joint"][0]["type"], "revolute");
    /// assert!(json.get("coupling").is_none()); // What is empty is left out.
    /// # Ok::<(), ozols::Error>(())
    /// ```
    #[must_use]
    pub fn json(&self) -> Value {
        stripped_json(self)
    }
}

/// Returns a value as JSON, without values that equal their default.
pub(crate) fn stripped_json(of: &impl Serialize) -> Value {
    let mut value = serde_json::to_value(of).unwrap_or_default();
    strip_defaults(&mut value);
    value
}

/// Removes empty values: null, false, "" (except names) and empty tables and lists.
fn strip_defaults(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(strip_defaults),
        Value::Object(map) => {
            map.values_mut().for_each(strip_defaults);
            map.retain(|k, v| match v {
                Value::Null | Value::Bool(false) => false,
                Value::String(s) => !s.is_empty() || k == "name",
                Value::Array(a) => !a.is_empty() || k == "freedoms",
                Value::Object(o) => !o.is_empty(),
                _ => true,
            });
        }
        _ => {}
    }
}

/// Returns the JSON Schema of the file; its `$id` contains the number of the contract.
///
/// # Examples
/// ```
/// let schema = ozols::file::schema::json_schema();
/// assert!(schema["properties"]["joint"].is_object());
/// ```
#[must_use]
pub fn json_schema() -> Value {
    let mut schema = schemars::schema_for!(MechanismFile);
    schema.insert("$id".to_owned(), "urn:ozols:mechanism:1".into());
    let mut schema = schema.to_value();
    default_to_null(&mut schema);
    schema
}

/// Adds null as the default of each key that may be null.
fn default_to_null(schema: &mut Value) {
    let Value::Object(own) = schema else { return };
    let is_null = |kind: &Value| kind == "null" || kind["type"] == "null";
    let kinds = own.get("type").or(own.get("anyOf"));
    let kinds = kinds.and_then(Value::as_array);
    if kinds.is_some_and(|all| all.iter().any(is_null)) {
        own.insert("default".to_owned(), Value::Null);
    }
    own.values_mut().for_each(default_to_null);
}

/// Returns the words and trade names of all joint types.
fn joint_words() -> Vec<&'static str> {
    let trade = JointType::TRADE_NAMES.map(|(name, _)| name);
    JointType::all_words().chain(trade).collect()
}
