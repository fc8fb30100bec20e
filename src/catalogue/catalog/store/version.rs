//! Versions of the tables, and how older ones are read and carried on.
//!
//! Every catalogue bears the version of its tables. One of [`OLDEST`] or later is brought up to date when it is next written
//! to, in the transaction that looks at it. Any older one can be read: what it did not keep is NULL.

use crate::catalog::prices::prices;
use itertools::Itertools;
use rusqlite::Connection;

/// What marks a file as a catalogue: "ozcg".
const APPLICATION: i64 = 0x6f7a_6367;
/// Version of the tables.
pub(super) const VERSION: i64 = 9;
/// The oldest version that can be carried on: those before lack counts that only building again gives.
pub(super) const OLDEST: i64 = 4;

/// The tables, each column with what it holds; the file carries these words, too (`.schema` shows them).
pub(crate) const TABLES: &str = include_str!("../tables.sql");

/// What each version but the first has beside the one before it: views that go, and what is made, by the words it begins with in
/// [`TABLES`].
const STEPS: [(i64, &str, &[&str]); 5] = [
    (5, "", &["CREATE TABLE parts"]),
    (
        6,
        "DROP VIEW IF EXISTS front;",
        &[
            "CREATE TABLE strokes",
            "CREATE VIEW grippers",
            "CREATE VIEW front",
        ],
    ),
    (
        7,
        "DROP VIEW IF EXISTS front; DROP VIEW IF EXISTS grippers;",
        &[
            "CREATE TABLE pairs",
            "CREATE TABLE classics",
            "CREATE VIEW grippers",
            "CREATE VIEW front",
        ],
    ),
    (
        8,
        "DROP VIEW IF EXISTS front; DROP VIEW IF EXISTS grippers;",
        &[
            "CREATE TABLE planes",
            "CREATE VIEW grippers",
            "CREATE VIEW front",
        ],
    ),
    (
        9,
        "DROP VIEW IF EXISTS front; DROP VIEW IF EXISTS grippers;",
        &[
            "CREATE TABLE prices",
            "CREATE VIEW grippers",
            "CREATE VIEW front",
        ],
    ),
];

/// The prices of parts, as rows.
fn price_rows() -> String {
    let row = |(part, price): &(&str, f64)| format!("('{part}', {price:?})");
    prices().iter().map(row).join(", ")
}

/// The statement of [`TABLES`] that begins so.
fn statement(begins: &str) -> &'static str {
    let rest = TABLES.find(begins).map_or("", |at| &TABLES[at..]);
    // Comments have semicolons, too, but none at the end of a line.
    rest.find(";\n").map_or(rest, |end| &rest[..=end])
}

/// Views in the place of tables that lack something, for whoever reads a version before the one named.
const VIEWS: [(i64, &str); 10] = [
    (
        8,
        "CREATE TEMP VIEW planes AS SELECT NULL AS structure, NULL AS planes, NULL AS links WHERE 0;",
    ),
    (
        7,
        "CREATE TEMP VIEW pairs AS SELECT NULL AS structure, NULL AS code, NULL AS slides, NULL AS gears, NULL AS slots, \
         NULL AS driven_from WHERE 0; CREATE TEMP VIEW classics AS SELECT NULL AS structure, NULL AS id, NULL AS about WHERE 0;",
    ),
    (
        6,
        "CREATE TEMP VIEW strokes AS SELECT NULL AS structure, NULL AS narrowest, NULL AS widest, NULL AS reached, NULL AS force_ratio, \
         NULL AS transmission, NULL AS pin_force, NULL AS efficiency, NULL AS width, NULL AS height, NULL AS margin_closing, \
         NULL AS margin_opening, NULL AS shortfall WHERE 0;",
    ),
    (
        5,
        "CREATE TEMP VIEW parts AS SELECT NULL AS part, NULL AS structures WHERE 0;",
    ),
    (
        4,
        "CREATE TEMP VIEW counts AS SELECT *, NULL AS orbits, NULL AS symmetric FROM main.counts;",
    ),
    // In the third the layouts have all but two columns; before that three jaws are not known of, either.
    (
        4,
        "CREATE TEMP VIEW IF NOT EXISTS layouts AS SELECT *, NULL AS closes, NULL AS orbits_w1 FROM main.layouts;",
    ),
    (
        3,
        "DROP VIEW temp.layouts; CREATE TEMP VIEW layouts AS SELECT *, NULL AS closes, NULL AS orbits_w1, NULL AS jaw_c_motion, \
         NULL AS tip_c_dx, NULL AS tip_c_dy FROM main.layouts;",
    ),
    (
        3,
        "CREATE TEMP VIEW structures AS SELECT *, NULL AS jaw_c FROM main.structures;",
    ),
    (
        2,
        "CREATE TEMP VIEW drawn AS SELECT NULL AS id, NULL AS name, NULL AS description, NULL AS links, NULL AS joints, \
         NULL AS contours, NULL AS mode, NULL AS input, NULL AS mechanism, NULL AS mobility, NULL AS redundant, NULL AS finite, \
         NULL AS determinate, NULL AS admissible, NULL AS certainty, NULL AS ideas_asked, NULL AS best_cost WHERE 0;",
    ),
    (
        3,
        "CREATE TEMP VIEW IF NOT EXISTS drawn AS SELECT *, NULL AS ideas_asked FROM main.drawn;",
    ),
];

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

/// Brings tables of a version from [`OLDEST`] on up to date, in the transaction that is open.
pub(super) fn migrate(db: &Connection, from: i64) -> rusqlite::Result<()> {
    for (version, gone, made) in STEPS.iter().filter(|(version, ..)| *version > from) {
        let made: String = made.iter().map(|begins| statement(begins)).collect();
        db.execute_batch(&format!("{gone} {made} PRAGMA user_version = {version};"))?;
    }
    if from < 9 {
        db.execute_batch(&format!("INSERT INTO prices VALUES {};", price_rows()))?;
    }
    Ok(())
}

/// Lets tables of an older version be read as those of this one.
pub(super) fn fill_in(db: &Connection, found: i64) -> rusqlite::Result<()> {
    for (_, view) in VIEWS.iter().filter(|(version, _)| found < *version) {
        db.execute_batch(view)?;
    }
    if found < 9 {
        db.execute_batch(&format!(
            "CREATE TEMP VIEW prices (part, price) AS VALUES {};",
            price_rows()
        ))?;
    }
    // They are of what the others hold: those of an older version lack columns.
    if found < VERSION {
        let view = statement("CREATE VIEW grippers").replacen("CREATE VIEW", "CREATE TEMP VIEW", 1);
        db.execute_batch(&view)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names and words of the tables and views of a database.
    fn schema(db: &Connection) -> Vec<(String, String)> {
        let sql = "SELECT name, sql FROM sqlite_schema WHERE sql IS NOT NULL ORDER BY name";
        let mut all = db.prepare(sql).unwrap();
        let rows = all.query_map([], |r| Ok((r.get(0)?, r.get(1)?))).unwrap();
        rows.map(Result::unwrap).collect()
    }

    /// What each version lacks of the one after it, the latest first. A `front` older than the tables it looks at stands for
    /// that of its version, which had other words.
    const WITHOUT: [(i64, &str); 8] = [
        (
            8,
            "DROP VIEW front; DROP VIEW grippers; DROP TABLE prices; CREATE VIEW front AS SELECT 1 AS id; \
             CREATE VIEW grippers AS SELECT 1 AS id;",
        ),
        (
            7,
            "DROP VIEW front; DROP VIEW grippers; DROP TABLE planes; CREATE VIEW front AS SELECT 1 AS id; \
             CREATE VIEW grippers AS SELECT 1 AS id;",
        ),
        (
            6,
            "DROP VIEW front; DROP VIEW grippers; DROP TABLE pairs; DROP TABLE classics; CREATE VIEW front AS SELECT 1 AS id; \
             CREATE VIEW grippers AS SELECT 1 AS id;",
        ),
        (5, "DROP VIEW grippers; DROP TABLE strokes;"),
        (4, "DROP TABLE parts;"),
        (
            3,
            "DROP VIEW idea_front; ALTER TABLE layouts DROP COLUMN closes; ALTER TABLE layouts DROP COLUMN orbits_w1; \
             ALTER TABLE counts DROP COLUMN orbits; ALTER TABLE counts DROP COLUMN symmetric;",
        ),
        (
            2,
            "ALTER TABLE structures DROP COLUMN jaw_c; ALTER TABLE layouts DROP COLUMN jaw_c_motion; \
             ALTER TABLE layouts DROP COLUMN tip_c_dx; ALTER TABLE layouts DROP COLUMN tip_c_dy; \
             ALTER TABLE drawn DROP COLUMN ideas_asked;",
        ),
        (1, "DROP TABLE drawn;"),
    ];

    /// A catalogue without a row whose tables are of this version.
    fn of_version(version: i64) -> Connection {
        let db = Connection::open_in_memory().unwrap();
        make(&db).unwrap();
        for (_, taken) in WITHOUT.iter().filter(|(without, _)| version <= *without) {
            db.execute_batch(taken).unwrap();
        }
        db.pragma_update(None, "user_version", version).unwrap();
        db
    }

    #[test]
    fn what_is_brought_up_to_date_is_as_if_made_so() {
        let new = Connection::open_in_memory().unwrap();
        assert_eq!(kind(&new).unwrap(), FileKind::Fresh);
        make(&new).unwrap();
        assert_eq!(kind(&new).unwrap(), FileKind::Catalogue(VERSION));
        for version in OLDEST..VERSION {
            let old = of_version(version);
            assert_eq!(kind(&old).unwrap(), FileKind::Catalogue(version));
            migrate(&old, version).unwrap();
            assert_eq!(kind(&old).unwrap(), FileKind::Catalogue(VERSION));
            assert_eq!(schema(&old), schema(&new), "{version}");
        }
    }

    /// Each version's tables, as far back as there are any, with the columns it lacked taken away.
    #[test]
    fn every_column_can_be_asked_of_every_version() {
        let tables = [
            "structures",
            "layouts",
            "drawn",
            "counts",
            "ideas",
            "parts",
            "strokes",
            "pairs",
            "classics",
            "planes",
            "prices",
            "grippers",
        ];
        let columns = |db: &Connection| {
            tables.map(|table| {
                let all = db.prepare(&format!("SELECT * FROM {table}")).unwrap();
                let names = all.column_names().into_iter().map(str::to_owned);
                names.collect::<std::collections::BTreeSet<String>>()
            })
        };
        let now = columns(&of_version(VERSION));
        for version in 1..VERSION {
            let db = of_version(version);
            fill_in(&db, version).unwrap();
            assert_eq!(columns(&db), now, "{version}");
        }
    }
}
