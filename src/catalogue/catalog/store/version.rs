//! The version of the tables, the errors of a catalogue, and the prices of parts.
//!
//! A catalogue of another version is rejected. Prices are in revolute joints, with bought parts and their fitting.

use crate::model::joint_type::JointType;
use crate::model::mechanism::CostSpec;
use itertools::Itertools;
use rusqlite::Connection;
use std::path::PathBuf;
use thiserror::Error;

/// Maximum size of an answer `[MiB]`. It is kept completely, since columns are as wide as their widest value.
pub(crate) const LARGEST_ANSWER: usize = 256;

/// Error of a catalogue file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StoreError {
    /// The file cannot be opened, read or written.
    #[error("{}: {why}", path.display())]
    Database {
        /// The file.
        path: PathBuf,
        /// The error of SQLite.
        why: rusqlite::Error,
    },
    /// The file is damaged: SQLite finds its pages inconsistent.
    #[error(
        "{0} is damaged ({why}): take a copy of it, or build it again under another name; `sqlite3 {0} .recover | sqlite3 NEW.db` saves \
         what can be read",
        path.display()
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// SQLite's message.
        why: String,
    },
    /// The file is not a catalogue.
    #[error(
        "{} is not a catalogue of ozols; choose another name, `ozols catalog build -o NAME.db` makes one", .0.display()
    )]
    Other(PathBuf),
    /// The file is empty.
    #[error(
        "{} is empty: the command that was making the catalogue was ended; run it again and it carries on", .0.display()
    )]
    Empty(PathBuf),
    /// The tables have another version.
    #[error(
        "{} has tables of version {found}, and this ozols reads version {VERSION} alone; build it again under another name: \
         `ozols catalog build -o NAME.db`",
        path.display()
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: i64,
    },
    /// The file holds another catalogue than the requested one.
    #[error(
        "{} holds another catalogue ({what} differs: {there} there, {asked} asked for); choose another file, or the same options", path.display()
    )]
    Differs {
        /// The file.
        path: PathBuf,
        /// The part of the specification that differs.
        what: String,
        /// Its value in the file.
        there: String,
        /// The requested value.
        asked: String,
    },
    /// The query would do more than read the catalogue.
    #[error(
        "{}: a catalogue is only read here: no ATTACH, no VACUUM INTO, no settings; ask with SELECT, and -o FILE keeps the answer", .0.display()
    )]
    ReadOnly(PathBuf),
    /// The query has an answer that would fill the memory.
    #[error("{}: the answer is larger than {LARGEST_ANSWER} MiB; ask for fewer columns, or for a part of the rows with LIMIT and OFFSET", .0.display())]
    LargeAnswer(PathBuf),
    /// There is no such structure.
    #[error("{} has no structure {id}; `ozols catalog query` lists them", path.display())]
    Unknown {
        /// The file.
        path: PathBuf,
        /// The requested id.
        id: String,
    },
    /// Several structures have ids that begin in this way.
    #[error("{id} is the beginning of {count} structures; give more of it")]
    Several {
        /// The requested id.
        id: String,
        /// Number of such structures.
        count: usize,
    },
}

/// Application id of catalogues: "ozcg".
const APPLICATION: i64 = 0x6f7a_6367;
/// Version of the tables. It is raised with every change of the tables, or of the meaning of a specification.
pub(super) const VERSION: i64 = 12;

/// The tables, with the meaning of each column. The file includes these comments, too (`.schema` shows them).
const TABLES: &str = include_str!("../tables.sql");

/// Returns the prices of parts, as rows.
fn price_rows() -> String {
    let row = |(part, price): &(&str, f64)| format!("('{part}', {price:?})");
    part_prices().iter().map(row).join(", ")
}

/// Kind of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FileKind {
    /// A database without tables, as it remains if the program is killed while it creates a catalogue.
    Fresh,
    /// A catalogue with tables of this version.
    Catalogue(i64),
    /// A file of another kind.
    Other,
}

/// Returns the kind of an open database.
pub(super) fn database_kind(db: &Connection) -> rusqlite::Result<FileKind> {
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
pub(super) fn make_tables(db: &Connection) -> rusqlite::Result<()> {
    db.execute_batch(&format!(
        "PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {VERSION}; {TABLES} INSERT INTO prices VALUES {};",
        price_rows()
    ))
}

/// A gear pair, or a rack and its pinion, in thousandths: two parts with teeth that must keep their distance.
const TEETH_MILLI: i64 = 3000;

/// Returns the price of each part by its name.
fn part_prices() -> [(&'static str, f64); 5] {
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
