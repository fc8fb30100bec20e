//! Opens catalogues for reading and writing.
//!
//! The kind of a file is checked in the transaction that would create its tables, after the remains of a killed command are
//! rolled back. So an unfinished catalogue counts as a new file. If several commands create one file, the first succeeds and
//! the others find it.

use super::held::{Store, Stored};
use super::version::{self, FileKind, VERSION};
use crate::catalog::spec::Spec;
use crate::catalog::store::version::StoreError;
use rusqlite::hooks::{AuthAction, AuthContext, Authorization};
use rusqlite::{Connection, ErrorCode, OpenFlags, ffi};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Time that a command waits for others that write to the same file.
const PATIENCE: Duration = Duration::from_secs(120);

/// Pragmas that only read properties of a table.
const TELLING: [&str; 7] = [
    "foreign_key_list",
    "index_info",
    "index_list",
    "index_xinfo",
    "table_info",
    "table_list",
    "table_xinfo",
];

impl Store {
    /// Opens a catalogue only to read. No query can write or open another file.
    ///
    /// # Errors
    /// Returns an error if the file is not a catalogue.
    pub fn open_readonly(path: &Path) -> Stored<Store> {
        let read = || {
            let db = open_connection(path, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
            let kind = file_kind(path, &db)?;
            Ok((db, kind))
        };
        let (db, kind) = match read() {
            Err(StoreError::Database { why, .. }) if is_half_written(&why) => {
                recover_file(path)?;
                read()?
            }
            done => done?,
        };
        match kind {
            FileKind::Fresh => return Err(StoreError::Empty(path.to_owned())),
            FileKind::Other => return Err(StoreError::Other(path.to_owned())),
            FileKind::Catalogue(found) => check_version(path, found)?,
        }
        check_pages(path, &db)?;
        Store::wrap_result(path, db.authorizer(Some(only_questions)))?;
        Ok(Store {
            path: path.to_owned(),
            db,
        })
    }

    /// Opens a catalogue of a specification to continue it, or creates it.
    ///
    /// # Errors
    /// Returns an error if the file is not a catalogue, or holds another one.
    pub fn open_or_create(path: &Path, spec: &Spec) -> Stored<Store> {
        Store::writable_of(path, &spec.to_canonical())
    }

    /// Opens or creates a catalogue of a specification.
    pub(super) fn writable_of(path: &Path, spec: &str) -> Stored<Store> {
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE;
        let db = open_connection(path, flags)?;
        // Rolls back the remains of a killed command, and locks out others that would create the tables.
        let begun = db.execute_batch("PRAGMA page_size = 8192; BEGIN IMMEDIATE");
        begun.map_err(|why| unreadable_error(path, why))?;
        match file_kind(path, &db)? {
            FileKind::Other => return Err(StoreError::Other(path.to_owned())),
            FileKind::Fresh => Store::wrap_result(path, version::make_tables(&db))?,
            FileKind::Catalogue(found) => {
                check_version(path, found)?;
                check_pages(path, &db)?;
            }
        }
        let mut store = Store {
            path: path.to_owned(),
            db,
        };
        store.be_of(spec)?;
        let done = store.db.execute_batch("COMMIT");
        store.check_result(done)?;
        Ok(store)
    }

    /// Stores the specification, or checks that it is the stored one.
    pub(super) fn be_of(&mut self, spec: &str) -> Stored<()> {
        match self.meta_value("spec")? {
            Some(there) if there != spec => Err(spec_difference(&self.path, &there, spec)),
            Some(_) => Ok(()),
            None => {
                self.set_meta("spec", spec)?;
                self.set_meta("ozols", env!("CARGO_PKG_VERSION"))
            }
        }
    }
}

/// Rejects a catalogue with tables of another version.
fn check_version(path: &Path, found: i64) -> Stored<()> {
    let path = path.to_owned();
    match found {
        VERSION => Ok(()),
        _ => Err(StoreError::Version { path, found }),
    }
}

/// Rejects a damaged file by SQLite's quick check, which reads every page once. Rows added to a damaged file may be lost.
fn check_pages(path: &Path, db: &Connection) -> Stored<()> {
    let found = db.query_row("PRAGMA quick_check(1)", [], |r| r.get::<_, String>(0));
    match Store::wrap_result(path, found)? {
        well if well == "ok" => Ok(()),
        // The first line names the database, the last one its first flaw.
        why => Err(StoreError::Damaged {
            path: path.to_owned(),
            why: why.lines().last().unwrap_or_default().to_owned(),
        }),
    }
}

/// Opens a database. Every name is that of a file, and the schema of a foreign file is not trusted.
fn open_connection(path: &Path, flags: OpenFlags) -> Stored<Connection> {
    let flags = flags | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let open = || {
        let db = Connection::open_with_flags(plain_name(path), flags)?;
        db.busy_timeout(PATIENCE)?;
        db.pragma_update(None, "trusted_schema", false)?;
        Ok(db)
    };
    Store::wrap_result(path, open())
}

/// Returns a name that SQLite reads as that of a file, such as one called `:memory:`.
pub(super) fn plain_name(path: &Path) -> PathBuf {
    if path.is_absolute() {
        path.to_owned()
    } else {
        Path::new(".").join(path)
    }
}

fn file_kind(path: &Path, db: &Connection) -> Stored<FileKind> {
    version::database_kind(db).map_err(|why| unreadable_error(path, why))
}

/// Returns the error of an unreadable file, which may not be a database.
fn unreadable_error(path: &Path, why: rusqlite::Error) -> StoreError {
    match why.sqlite_error_code() {
        Some(ErrorCode::NotADatabase) => StoreError::Other(path.to_owned()),
        _ => Store::wrap_error(path, why),
    }
}

/// Returns true if a killed command left a transaction to roll back, which a read-only connection cannot do.
fn is_half_written(why: &rusqlite::Error) -> bool {
    let code = why.sqlite_error().map(|e| e.extended_code);
    matches!(
        code,
        Some(ffi::SQLITE_READONLY_ROLLBACK | ffi::SQLITE_READONLY_RECOVERY)
    )
}

/// Rolls back the remains of a killed command.
fn recover_file(path: &Path) -> Stored<()> {
    let db = open_connection(path, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
    file_kind(path, &db).map(drop)
}

fn only_questions(asked: AuthContext<'_>) -> Authorization {
    match asked.action {
        AuthAction::Attach { .. } | AuthAction::Detach { .. } => Authorization::Deny,
        AuthAction::Pragma {
            pragma_name,
            pragma_value: Some(_),
        } if !TELLING.contains(&pragma_name) => Authorization::Deny,
        _ => Authorization::Allow,
    }
}

/// Returns the difference of two specifications.
fn spec_difference(path: &Path, there: &str, asked: &str) -> StoreError {
    let line = |text: &str, other: &str| {
        let lines = other.lines().collect::<BTreeSet<_>>();
        let differs = text.lines().find(|l| !lines.contains(l));
        differs.unwrap_or("nothing").to_owned()
    };
    let (there, asked) = (line(there, asked), line(asked, there));
    StoreError::Differs {
        path: path.to_owned(),
        what: asked.split(" = ").next().unwrap_or("it").to_owned(),
        there,
        asked,
    }
}
