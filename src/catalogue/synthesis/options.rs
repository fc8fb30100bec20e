//! Options of joints: joint types that may replace a joint. The menu has those of hinges. Those of slides, slots and nuts are fixed.

use crate::file::schema::{Coordinate, OptionEntry, OptionTable};
use crate::synthesis::place::Pivot;

/// The changes that a search may make to hinges.
#[derive(Debug, Clone, Default)]
pub struct Menu {
    /// The types that may replace each hinge, the hinge itself first.
    pub options: Vec<OptionEntry>,
    /// The joints that may be put in series with each hinge, with one more link. The input joint gets none.
    pub unloading: Vec<OptionEntry>,
}

/// Returns a direction of whole numbers after N thirds of a turn.
pub(super) fn direction_turned(
    direction: &[Coordinate; 3],
    pivot: Pivot,
    thirds: u8,
) -> [Coordinate; 3] {
    let [
        Coordinate::Integer(x),
        Coordinate::Integer(y),
        Coordinate::Integer(z),
    ] = direction
    else {
        return direction.clone();
    };
    #[allow(clippy::cast_precision_loss, reason = "sides of small triangles")]
    pivot.turned([x, y, z].map(|a| *a as f64), thirds)
}

/// Returns options after N thirds of a turn, with their directions turned.
pub(super) fn options_turned(
    options: &[OptionEntry],
    pivot: Pivot,
    thirds: u8,
) -> Vec<OptionEntry> {
    let mut out = options.to_vec();
    for option in &mut out {
        if let OptionEntry::Table(t) = option {
            let turned = |d| direction_turned(d, pivot, thirds);
            t.reference = t.reference.as_ref().map(turned);
        }
    }
    out
}

/// Returns whether an option turns about any axis.
pub(super) fn is_ball(option: &OptionEntry) -> bool {
    let balls = ["spherical", "sphere-in-cylinder"];
    matches!(option, OptionEntry::Word(word) if balls.contains(&word.as_str()))
}

fn named(name: &str, freedoms: &[&str]) -> OptionEntry {
    with_lead(None, name, freedoms)
}

fn with_lead(lead: Option<i64>, name: &str, freedoms: &[&str]) -> OptionEntry {
    OptionEntry::Table(Box::new(OptionTable {
        freedoms: Some(freedoms.iter().map(|f| (*f).to_owned()).collect()),
        lead: lead.map(Coordinate::Integer),
        name: Some(name.to_owned()),
        ..OptionTable::default()
    }))
}

fn word(kind: &str) -> OptionEntry {
    OptionEntry::Word(kind.to_owned())
}

/// Returns the types that may replace a guide: z is along it, x is square to the plane of motion.
pub(super) fn slide_options() -> Vec<OptionEntry> {
    vec![
        word("prismatic"),
        word("cylindrical"),
        named("tongue-in-groove", &["tz", "tx"]),
        named("round-tongue-in-groove", &["tz", "tx", "rz"]),
        named("ball-in-groove", &["tz", "tx", "rz", "ry"]),
    ]
}

/// Returns the types that may replace flat faces: z is along them, x is square to the plane of motion.
pub(super) fn face_options() -> Vec<OptionEntry> {
    let of_slots = vec![
        named("pin-in-slot", &["tz", "rx"]),
        named("pin-in-deep-slot", &["tz", "rx", "tx"]),
        named("ball-in-slot", &["tz", "rx", "ry", "rz"]),
        named("ball-in-deep-slot", &["tz", "tx", "rx", "ry", "rz"]),
    ];
    slide_options().into_iter().chain(of_slots).collect()
}

/// Returns the types that may replace a pin in a slot: z is along the pin, x is along the slot.
pub(super) fn slot_options() -> Vec<OptionEntry> {
    vec![
        word("slotted"),
        named("pin-in-deep-slot", &["rz", "tx", "tz"]),
        named("ball-in-slot", &["rx", "ry", "rz", "tx"]),
        named("ball-in-deep-slot", &["rx", "ry", "rz", "tx", "tz"]),
    ]
}

/// Returns the types that may replace a nut: z is along the screw.
pub(super) fn nut_options(lead: i64) -> Vec<OptionEntry> {
    let nut = |name, freedoms: &[&str]| with_lead(Some(lead), name, freedoms);
    vec![
        nut("nut", &["screw"]),
        nut("floating-nut", &["screw", "tx", "ty"]),
        nut("nut-in-ball", &["screw", "rx", "ry"]),
        nut("floating-nut-in-ball", &["screw", "rx", "ry", "tx", "ty"]),
    ]
}
