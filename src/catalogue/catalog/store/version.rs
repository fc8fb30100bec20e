//! The version of the tables: every catalogue bears it, and one of another version is refused; and what the parts of a gripper cost, in
//! revolute joints, by what is bought and what has to be fitted for it.

use crate::model::joint_type::JointType;
use crate::model::mechanism::CostSpec;
use itertools::Itertools;
use rusqlite::Connection;

/// What marks a file as a catalogue: "ozcg".
const APPLICATION: i64 = 0x6f7a_6367;
/// Version of the tables; it is raised with every change of them, and of what a specification says.
pub(super) const VERSION: i64 = 9;

/// The tables, each column with what it holds; the file carries these words, too (`.schema` shows them).
const TABLES: &str = include_str!("../tables.sql");

/// Returns the prices of parts, as rows.
fn price_rows() -> String {
    let row = |(part, price): &(&str, f64)| format!("('{part}', {price:?})");
    prices().iter().map(row).join(", ")
}

/// What a file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FileKind {
    /// A database without a table, as a kill leaves it that comes while a catalogue is being made.
    Fresh,
    /// A catalogue with tables of this version.
    Catalogue(i64),
    /// Something else.
    Other,
}

/// What an open database is.
pub(super) fn kind(db: &Connection) -> rusqlite::Result<FileKind> {
    let number = |name: &str| db.pragma_query_value(None, name, |r| r.get::<_, i64>(0));
    let (application, version) = (number("application_id")?, number("user_version")?);
    let tables: i64 = db.query_row("SELECT count(*) FROM main.sqlite_schema", [], |r| r.get(0))?;
    Ok(match (application, version, tables) {
        (0, 0, 0) => FileKind::Fresh,
        (APPLICATION, version, 1..) => FileKind::Catalogue(version),
        _ => FileKind::Other,
    })
}

/// Makes the tables, in the transaction that is open.
pub(super) fn make(db: &Connection) -> rusqlite::Result<()> {
    db.execute_batch(&format!(
        "PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {VERSION}; {TABLES} INSERT INTO prices VALUES {};",
        price_rows()
    ))
}

/// A gear pair, or a rack and its pinion, in thousandths: two parts with teeth, and their distance is to be kept.
const TEETH_MILLI: i64 = 3000;

/// The price of each part by its name.
fn prices() -> [(&'static str, f64); 5] {
    #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
    let whole = |milli: i64| milli as f64 / 1000.0;
    let joint = |of: JointType| whole(of.default_cost_milli());
    [
        ("hinge", joint(JointType::Revolute)),
        ("slide", joint(JointType::Prismatic)),
        ("gear", whole(TEETH_MILLI)),
        ("slot", joint(JointType::Slotted)),
        ("link", whole(CostSpec::LINK_MILLI)),
    ]
}
