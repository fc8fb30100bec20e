//! What may stand in the place of a joint: of a hinge by the menu, of slides, slots and nuts always the same.

use crate::file::schema::{Coordinate, OptionEntry, OptionTable};
use crate::synthesis::place::Pivot;

/// What a search may do to the hinges.
#[derive(Debug, Clone, Default)]
pub struct Menu {
    /// What each may be, the hinge itself first.
    pub options: Vec<OptionEntry>,
    /// What may be put in series with each, by a link more; with the input joint nothing is.
    pub unloading: Vec<OptionEntry>,
}

/// A direction of whole numbers after so many thirds of a turn.
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

/// Options after so many thirds of a turn: their directions go with it.
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

/// Whether an option turns about any axis.
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

/// What may be in place of a guide: z along it, x square to the plane of motion.
pub(super) fn slides() -> Vec<OptionEntry> {
    vec![
        word("prismatic"),
        word("cylindrical"),
        named("tongue-in-groove", &["tz", "tx"]),
        named("round-tongue-in-groove", &["tz", "tx", "rz"]),
        named("ball-in-groove", &["tz", "tx", "rz", "ry"]),
    ]
}

/// What may be in place of flat faces: z along them, x square to the plane of motion.
pub(super) fn faces() -> Vec<OptionEntry> {
    let of_slots = vec![
        named("pin-in-slot", &["tz", "rx"]),
        named("pin-in-deep-slot", &["tz", "rx", "tx"]),
        named("ball-in-slot", &["tz", "rx", "ry", "rz"]),
        named("ball-in-deep-slot", &["tz", "tx", "rx", "ry", "rz"]),
    ];
    slides().into_iter().chain(of_slots).collect()
}

/// What may be in place of a pin in a slot: z along the pin, x along the slot.
pub(super) fn slots() -> Vec<OptionEntry> {
    vec![
        word("slotted"),
        named("pin-in-deep-slot", &["rz", "tx", "tz"]),
        named("ball-in-slot", &["rx", "ry", "rz", "tx"]),
        named("ball-in-deep-slot", &["rx", "ry", "rz", "tx", "tz"]),
    ]
}

/// What may be in place of a nut: z along the screw.
pub(super) fn nuts(lead: i64) -> Vec<OptionEntry> {
    let nut = |name, freedoms: &[&str]| with_lead(Some(lead), name, freedoms);
    vec![
        nut("nut", &["screw"]),
        nut("floating-nut", &["screw", "tx", "ty"]),
        nut("nut-in-ball", &["screw", "rx", "ry"]),
        nut("floating-nut-in-ball", &["screw", "rx", "ry", "tx", "ty"]),
    ]
}
