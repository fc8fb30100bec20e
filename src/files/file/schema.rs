//! The mechanism file: one schema for TOML and JSON.

mod grip;
mod number;
mod ranking;
mod workload;

use crate::format::disjunction;
use crate::model::joint_type::JointType;
pub use grip::{DiameterSteps, Diameters, Gravity, GripEntry};
pub use number::ToleranceEntry;
pub use number::Words;
pub use number::{Coordinate, Quantities, Quantity};
pub use ranking::{JointTypeEntry, LimitEntry, RankingEntry, TermEntry};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::borrow::Cow;
use std::collections::BTreeMap;
pub use workload::{
    ContactEntry, DriveEntry, ForceEntry, InertiaEntry, MisalignmentEntry, MomentEntry,
    StiffnessEntry, StrokeEntry, WorkloadEntry,
};

/// A mechanism: links, joints, and what a search may change.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MechanismFile {
    /// Short name, such as "four-bar".
    pub name: String,
    /// One or two sentences for people.
    #[serde(default)]
    pub description: String,
    /// Publications the mechanism and its figures come from.
    #[serde(default)]
    pub sources: Vec<String>,
    /// What the reader of another format took for granted or left out, a sentence each: figures are those of the file as read.
    #[serde(default)]
    pub assumed: Vec<String>,
    /// Unit of all lengths: m (the default), mm, cm, um or in.
    pub length_unit: Option<String>,
    /// "spatial" (the default, 6 rows per contour) or "planar" (3 rows).
    pub mode: Option<String>,
    /// Normal of the plane of motion in planar mode; z by default.
    pub plane_normal: Option<[Coordinate; 3]>,
    /// Numbers by name, for expressions: `[parameter]` with `height = 40`, and `point = [0, "2*height", 0]`.
    #[serde(default)]
    pub parameter: BTreeMap<String, Coordinate>,
    /// How well numbers are known: half a unit of their last digit where left out.
    pub tolerance: Option<ToleranceEntry>,
    /// The rigid bodies.
    #[serde(default)]
    pub link: Vec<LinkEntry>,
    /// The joints.
    #[serde(default)]
    pub joint: Vec<JointEntry>,
    /// Joints that move in a fixed ratio: gears, belts, racks, mimic joints.
    #[serde(default)]
    pub coupling: Vec<CouplingEntry>,
    /// A basis of contours, where a particular one is wanted.
    #[serde(default)]
    pub contour: Vec<ContourEntry>,
    /// Points of interest on links, which drawings show, with their way over a stroke.
    #[serde(default)]
    pub point: Vec<PointEntry>,
    /// What a search may do.
    #[serde(default)]
    pub search: SearchEntry,
    /// Loads and drive, for `ozols statics`.
    #[serde(default)]
    pub workload: WorkloadEntry,
    /// How `ozols search` ranks variants under the workload; by cost alone where left out.
    pub ranking: Option<RankingEntry>,
    /// What joint types bear, in place of the built-in catalogue: `[joint_types.spherical]`.
    #[serde(default)]
    pub joint_types: BTreeMap<String, JointTypeEntry>,
    /// Known figures, which `ozols check` compares with those of the analysis.
    #[serde(default)]
    pub expected: Vec<ExpectedEntry>,
    /// What publications say of this mechanism, so or not; repeated by the command that it is about.
    #[serde(default)]
    pub claim: Vec<ClaimEntry>,
}

/// A rigid body.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinkEntry {
    /// Name, unique among links.
    pub id: String,
    /// "frame", "output" or "object"; nothing for the rest.
    pub role: Option<String>,
    /// Mass in kg.
    pub mass: Option<f64>,
    /// Mass centre, at the pose of the file.
    pub centre: Option<[Coordinate; 3]>,
    /// Inertia about the mass centre in kg·m²: a number about the plane's normal, or 3 or 6 in space.
    pub inertia: Option<InertiaEntry>,
}

/// A joint between two links.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointEntry {
    /// Name, unique among joints.
    pub id: String,
    /// The two links.
    pub links: [String; 2],
    /// Its type, of those that [`JointType`] has.
    #[schemars(description = format!("Type: {}.", disjunction(JointType::words())))]
    #[schemars(extend("enum" = joint_words()))]
    #[serde(rename = "type")]
    pub kind: String,
    /// Freedoms of a custom joint: rx, ry, rz, tx, ty, tz, screw.
    pub freedoms: Option<Vec<String>>,
    /// Origin of the joint's frame.
    pub point: [Coordinate; 3],
    /// Direction of z, of any length; z where left out for spherical and fixed joints.
    pub axis: Option<[Coordinate; 3]>,
    /// Direction that x is made from; by default the first of the global x, y, z not parallel to the axis.
    pub reference: Option<[Coordinate; 3]>,
    /// Translation per turn of a helical joint: what catalogues of screws call its lead.
    pub lead: Option<Coordinate>,
    /// Translation per radian of a helical joint, in place of its lead; may have pi in it: "5/(2*pi)".
    pub pitch: Option<Coordinate>,
    /// The point is within so much of what is meant, in the file's unit of length; 0 where it is exact.
    pub tolerance: Option<Coordinate>,
    /// Whether the mechanism is driven here: true, or the freedom that is driven, such as "tz", where the joint has several. A
    /// driven joint is not changed unless it has options of its own.
    #[serde(default)]
    pub drive: DriveWord,
    /// The state, or list of states, in which the joint is present; all where left out.
    pub state: Option<Words>,
    /// What a search may put here instead of the `[search]` list.
    pub options: Option<Vec<OptionEntry>>,
    /// Names of options never put here.
    #[serde(default)]
    pub forbid: Vec<String>,
    /// Joints that may be inserted here in series: true for those of `[search]`, or a list.
    pub unloading: Option<Unloading>,
}

/// Whether a joint is driven, and where.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected true, false or the freedom that is driven, such as \"tz\""
)]
pub enum DriveWord {
    /// In its only freedom, or in the one that takes the greatest part in the motion of the outputs.
    Driven(bool),
    /// In this one: rx, ry, rz, tx, ty, tz, screw.
    Freedom(String),
}

impl Default for DriveWord {
    fn default() -> Self {
        DriveWord::Driven(false)
    }
}

/// Whether and what unloading joints may be inserted.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected true, false or a list of joint options"
)]
pub enum Unloading {
    /// True: those of `[search]`.
    Allowed(bool),
    /// These.
    List(Vec<OptionEntry>),
}

/// A joint that a search may put somewhere: a type name or a table.
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
    /// The option spelt out.
    pub(crate) fn table(&self) -> Cow<'_, OptionTable> {
        match self {
            OptionEntry::Table(table) => Cow::Borrowed(table),
            OptionEntry::Word(kind) => Cow::Owned(OptionTable {
                kind: Some(kind.clone()),
                ..OptionTable::default()
            }),
        }
    }
}

/// A joint option spelt out.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OptionTable {
    /// The type; custom where only freedoms are given.
    #[serde(rename = "type")]
    pub kind: Option<String>,
    /// Freedoms of a custom joint.
    pub freedoms: Option<Vec<String>>,
    /// Origin, the joint's own by default.
    pub point: Option<[Coordinate; 3]>,
    /// Direction of z, the joint's own by default.
    pub axis: Option<[Coordinate; 3]>,
    /// Direction that x is made from; by default the joint's own, and where that is parallel to the option's axis, the first of
    /// the global x, y, z not parallel to it.
    pub reference: Option<[Coordinate; 3]>,
    /// Translation per turn of a helical joint: what catalogues of screws call its lead.
    pub lead: Option<Coordinate>,
    /// Translation per radian of a helical joint, in place of its lead; may have pi in it: "5/(2*pi)".
    pub pitch: Option<Coordinate>,
    /// Name shown in results.
    pub name: Option<String>,
    /// Cost, in place of the table's.
    pub cost: Option<f64>,
    /// The state that must be searched for it to be offered; offered in any search where left out.
    pub state: Option<String>,
}

/// Two joints that move in a fixed ratio.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CouplingEntry {
    /// The two joints; "joint:freedom", such as "a:tz", for a joint of several freedoms.
    pub joints: [String; 2],
    /// Rate of the second joint over that of the first, in radians and the file's length unit: "-1/2" for a pair of
    /// gears of 20 and 40 teeth, the pitch radius for a pinion and its rack.
    pub ratio: Coordinate,
    /// Gears make it, or a rack and its pinion: it is drawn as their pitch circles. Anything else is drawn as a line.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub gear: bool,
}

/// A contour of the basis, by its joints in order.
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
    /// Where it is at the pose of the file.
    pub point: [Coordinate; 3],
    /// The point is within so much of what is meant, in the file's unit of length; 0 where it is exact.
    pub tolerance: Option<Coordinate>,
}

/// What a search may do.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SearchEntry {
    /// Options of joints without their own, except drives, fixed joints and contacts.
    pub options: Vec<OptionEntry>,
    /// Unloading joints for places with `unloading = true`.
    pub unloading: Vec<OptionEntry>,
    /// Links besides the outputs that must not gain a motion.
    pub hold: Vec<String>,
    /// Pairs of joints that are mirror images.
    pub mirror: Vec<[String; 2]>,
    /// Joints that become each other when the mechanism is turned about one axis, each the next and the last the first: pairs by
    /// half a turn, or groups of three by a third. Not beside mirror images.
    pub turn: Vec<Vec<String>>,
    /// Costs by option or type name, and `change`, `driven` (of changing a driven joint besides), `link` and `harmful` (of each
    /// harmful redundant constraint that a searched state adds).
    pub costs: BTreeMap<String, f64>,
}

/// Known figures of a state.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExpectedEntry {
    /// The state; free by default.
    pub state: Option<String>,
    /// W, instantaneous, idle freedoms included.
    pub mobility: Option<i64>,
    /// W of the motion that is really there; smaller than `mobility` at singular and shaky poses.
    pub finite_mobility: Option<i64>,
    /// Dimension of the output links' motion.
    pub working_mobility: Option<i64>,
    /// W less the working mobility.
    pub local_mobility: Option<i64>,
    /// σ of the whole state.
    pub redundant: Option<i64>,
    /// σ that the state adds to the free one.
    pub external_redundant: Option<i64>,
    /// Publication or derivation.
    #[serde(default)]
    pub source: String,
}

/// A claim of a publication.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClaimEntry {
    /// What it is about: "structure", "grip", "drive" or "statics".
    pub topic: String,
    /// The publication and the place in it.
    pub source: String,
    /// What is said there.
    pub says: String,
    /// What is right instead; left out where the claim holds.
    pub right: Option<String>,
    /// The part of a scanned text that a refutation rests on, where a misread letter would explain it.
    pub scan: Option<String>,
    /// What that rests on.
    pub evidence: String,
}

impl MechanismFile {
    /// The file as JSON, without what is left at its default.
    #[must_use]
    pub fn json(&self) -> Value {
        let mut value = serde_json::to_value(self).unwrap_or_default();
        strip(&mut value);
        value
    }
}

/// Removes what says nothing: null, false, "" (but for names) and empty tables and lists.
fn strip(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(strip),
        Value::Object(map) => {
            map.values_mut().for_each(strip);
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

/// The JSON Schema of the file, which its `$id` names with the number of the contract.
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
    JointType::words().chain(trade).collect()
}
