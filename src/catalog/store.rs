//! The file of a catalogue: an SQLite database, a structure a transaction, so that it can be ended at any moment and
//! carried on.

use crate::catalog::drawn::Drawn;
use crate::catalog::insert;
use crate::catalog::row::Row;
use crate::catalog::spec::Spec;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, OptionalExtension, params};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Duration;
use thiserror::Error;

/// What marks a file as a catalogue: "ozcg".
const APPLICATION: i64 = 0x6f7a_6367;
/// Version of the tables.
const VERSION: i64 = 4;

/// The tables, each column with what it holds; the file carries these words, too (`.schema` shows them).
pub const TABLES: &str = include_str!("tables.sql");

/// What is wrong with a catalogue.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StoreError {
    /// The file cannot be opened, read or written.
    #[error("{}: {why}", path.display())]
    Database {
        /// The file.
        path: PathBuf,
        /// Why not.
        why: rusqlite::Error,
    },
    /// The file is something else.
    #[error(
        "{} is no catalogue of ozols; choose another name, `ozols catalog build -o NAME.db` makes one", .0.display()
    )]
    Other(PathBuf),
    /// Tables of another version.
    #[error("{} was made by another version of ozols (tables {found}, this one has {VERSION}); build it again", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: i64,
    },
    /// It holds something else than what is asked for.
    #[error(
        "{} holds another catalogue ({what} differs: {there} there, {asked} asked for); choose another file, or the same options", path.display()
    )]
    Differs {
        /// The file.
        path: PathBuf,
        /// Which part.
        what: String,
        /// What it holds.
        there: String,
        /// What is asked.
        asked: String,
    },
    /// No such structure.
    #[error("{} has no structure {id}; `ozols catalog query` lists them", path.display())]
    Unknown {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        id: String,
    },
    /// Several structures begin so.
    #[error("{id} is the beginning of {count} structures; give more of it")]
    Several {
        /// What was asked for.
        id: String,
        /// How many.
        count: usize,
    },
}

/// An open catalogue.
#[derive(Debug)]
pub struct Store {
    path: PathBuf,
    db: Connection,
}

type Stored<T> = Result<T, StoreError>;

impl Store {
    fn wrap<T>(path: &Path, result: rusqlite::Result<T>) -> Stored<T> {
        result.map_err(|why| StoreError::Database {
            path: path.to_owned(),
            why,
        })
    }

    fn ok<T>(&self, result: rusqlite::Result<T>) -> Stored<T> {
        Store::wrap(&self.path, result)
    }

    /// Opens a catalogue to read.
    ///
    /// # Errors
    /// Where there is none.
    pub fn open(path: &Path) -> Stored<Store> {
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let db = Store::wrap(path, Connection::open_with_flags(path, flags))?;
        Store::checked(path, db)
    }

    fn checked(path: &Path, db: Connection) -> Stored<Store> {
        let number = |name: &str| db.pragma_query_value(None, name, |r| r.get::<_, i64>(0));
        let application =
            number("application_id").map_err(|why| match why.sqlite_error_code() {
                Some(rusqlite::ErrorCode::NotADatabase) => StoreError::Other(path.to_owned()),
                _ => StoreError::Database {
                    path: path.to_owned(),
                    why,
                },
            })?;
        let found = Store::wrap(path, number("user_version"))?;
        if application != APPLICATION {
            return Err(StoreError::Other(path.to_owned()));
        }
        if found != VERSION {
            let path = path.to_owned();
            return Err(StoreError::Version { path, found });
        }
        Ok(Store {
            path: path.to_owned(),
            db,
        })
    }

    /// Opens a catalogue to carry on, or makes one, that holds what a specification asks for.
    ///
    /// # Errors
    /// Where the file is something else, or holds another catalogue.
    pub fn create(path: &Path, spec: &Spec) -> Stored<Store> {
        let mut store = Store::writable(path)?;
        let same = spec.canonical();
        match store.meta("spec")? {
            Some(there) if there != same => {
                let line = |text: &str, other: &str| {
                    let lines = other.lines().collect::<BTreeSet<_>>();
                    let differs = text.lines().find(|l| !lines.contains(l));
                    differs.unwrap_or("nothing").to_owned()
                };
                let (there, asked) = (line(&there, &same), line(&same, &there));
                let what = asked.split(" = ").next().unwrap_or("it").to_owned();
                let path = path.to_owned();
                Err(StoreError::Differs {
                    path,
                    what,
                    there,
                    asked,
                })
            }
            Some(_) => Ok(store),
            None => {
                store.set_meta("spec", &same)?;
                store.set_meta("ozols", env!("CARGO_PKG_VERSION"))?;
                Ok(store)
            }
        }
    }

    /// Opens a catalogue to write to, or makes an empty one.
    ///
    /// # Errors
    /// Where the file is something else.
    pub fn writable(path: &Path) -> Stored<Store> {
        let fresh = std::fs::metadata(path).map_or(true, |m| m.len() == 0);
        let db = Store::wrap(path, Connection::open(path))?;
        Store::wrap(path, db.busy_timeout(Duration::from_secs(30)))?;
        if fresh {
            let tables = format!(
                "PRAGMA page_size = 8192; BEGIN IMMEDIATE; PRAGMA application_id = {APPLICATION}; \
                 PRAGMA user_version = {VERSION}; {TABLES} COMMIT;"
            );
            let made = db.execute_batch(&tables);
            // Another that builds the same file may have been first.
            if made.is_err() && db.is_autocommit() {
                return Store::checked(path, db);
            }
            Store::wrap(path, made)?;
        }
        Store::checked(path, db)
    }

    fn meta(&self, key: &str) -> Stored<Option<String>> {
        let sql = "SELECT value FROM meta WHERE key = ?1";
        let found = self.db.query_row(sql, [key], |r| r.get(0)).optional();
        self.ok(found)
    }

    fn set_meta(&mut self, key: &str, value: &str) -> Stored<()> {
        let sql = "INSERT OR REPLACE INTO meta VALUES (?1, ?2)";
        let done = self.db.execute(sql, [key, value]);
        self.ok(done.map(|_| ()))
    }

    /// The ids of the structures that are there.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn ids(&self) -> Stored<BTreeSet<String>> {
        let all = || -> rusqlite::Result<BTreeSet<String>> {
            let mut query = self.db.prepare("SELECT id FROM structures")?;
            let ids = query.query_map([], |r| r.get(0))?;
            ids.collect()
        };
        self.ok(all())
    }

    /// Adds a structure with all that is known of it, at once or not at all.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn add(&mut self, row: &Row) -> Stored<()> {
        let mut all = || -> rusqlite::Result<()> {
            let t = self.db.transaction()?;
            insert::row(&t, row)?;
            t.commit()
        };
        let done = all();
        self.ok(done)
    }

    /// Whether a drawn mechanism is there, searched for so many ideas.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn has_drawn(&self, id: &str, ideas: usize) -> Stored<bool> {
        let sql = "SELECT count(*) FROM drawn WHERE id = ?1 AND ideas_asked = ?2";
        let ideas = i64::try_from(ideas).unwrap_or(i64::MAX);
        let there = self
            .db
            .query_row(sql, params![id, ideas], |r| r.get::<_, i64>(0));
        Ok(self.ok(there)? > 0)
    }

    /// Adds a drawn mechanism with all that is known of it, at once or not at all, in place of an earlier search of it.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn add_drawn(&mut self, drawn: &Drawn) -> Stored<()> {
        let mut all = || -> rusqlite::Result<()> {
            let t = self.db.transaction()?;
            insert::drawn(&t, drawn)?;
            t.commit()
        };
        let done = all();
        self.ok(done)
    }

    /// The whole id that begins so.
    ///
    /// # Errors
    /// Where there is none, or more than one.
    pub fn find(&self, id: &str) -> Stored<String> {
        let all = || -> rusqlite::Result<Vec<String>> {
            let sql = "SELECT id FROM (SELECT id, name FROM structures UNION ALL SELECT id, name FROM drawn) \
                 WHERE substr(id, 1, ?2) = ?1 OR name = ?1 ORDER BY id";
            let mut query = self.db.prepare(sql)?;
            let length = i64::try_from(id.chars().count()).unwrap_or(i64::MAX);
            let ids = query.query_map(params![id, length], |r| r.get(0))?;
            ids.collect()
        };
        let found = self.ok(all())?;
        match &found[..] {
            [one] if !id.is_empty() => Ok(one.clone()),
            [] | [_] => Err(StoreError::Unknown {
                path: self.path.clone(),
                id: id.to_owned(),
            }),
            more => Err(StoreError::Several {
                id: id.to_owned(),
                count: more.len(),
            }),
        }
    }

    /// The answer to a question in SQL, with `?1` in it for `id`: names of columns, and rows.
    ///
    /// # Errors
    /// Where the question is wrong.
    pub fn query(&self, sql: &str, id: Option<&str>) -> Stored<(Vec<String>, Vec<Vec<Value>>)> {
        let all = || -> rusqlite::Result<_> {
            let mut query = self.db.prepare(sql)?;
            let names: Vec<String> = query
                .column_names()
                .into_iter()
                .map(str::to_owned)
                .collect();
            let width = names.len();
            let row =
                |r: &rusqlite::Row<'_>| (0..width).map(|i| Ok(plain(r.get_ref(i)?))).collect();
            let rows = query.query_map(rusqlite::params_from_iter(id), row)?;
            Ok((names, rows.collect::<rusqlite::Result<Vec<Vec<Value>>>>()?))
        };
        self.ok(all())
    }

    /// Takes in the structures of another catalogue of the same specification that this one has not; how many.
    ///
    /// # Errors
    /// Where it holds another catalogue.
    pub fn merge(path: &Path, parts: &[PathBuf]) -> Stored<usize> {
        let mut store: Option<Store> = None;
        let mut added = 0;
        for part in parts {
            let from = Store::open(part)?;
            let here = match (store.take(), from.meta("spec")?) {
                (Some(s), None) => s,
                // Drawn mechanisms alone go with any.
                (None, None) => Store::writable(path)?,
                (Some(s), same) if s.meta("spec")? == same => s,
                (_, Some(text)) => {
                    let spec = toml::from_str(&text);
                    let spec: Spec = spec.map_err(|_| StoreError::Other(part.clone()))?;
                    Store::create(path, &spec)?
                }
            };
            added += here.take_in(part)?;
            store = Some(here);
        }
        Ok(added)
    }

    fn take_in(&self, part: &Path) -> Stored<usize> {
        let all = || -> rusqlite::Result<usize> {
            let name = part.to_string_lossy();
            self.db.execute("ATTACH DATABASE ?1 AS part", [&name])?;
            let count = "SELECT (SELECT count(*) FROM part.structures WHERE id NOT IN (SELECT id FROM main.structures)) \
                         + (SELECT count(*) FROM part.drawn WHERE id NOT IN (SELECT id FROM main.drawn))";
            let added: i64 = self.db.query_row(count, [], |r| r.get(0))?;
            self.db.execute_batch(
                // What is there already stays as it is, with no idea of another search of it.
                "BEGIN IMMEDIATE;
                 CREATE TEMP TABLE there AS SELECT id FROM main.structures UNION ALL SELECT id FROM main.drawn;
                 INSERT INTO main.structures SELECT * FROM part.structures WHERE id NOT IN there;
                 INSERT INTO main.drawn SELECT * FROM part.drawn WHERE id NOT IN there;
                 INSERT INTO main.layouts SELECT * FROM part.layouts WHERE structure NOT IN there;
                 INSERT INTO main.counts SELECT * FROM part.counts WHERE structure NOT IN there;
                 INSERT INTO main.ideas SELECT * FROM part.ideas WHERE structure NOT IN there;
                 DROP TABLE there; COMMIT; DETACH DATABASE part;",
            )?;
            Ok(usize::try_from(added).unwrap_or(0))
        };
        self.ok(all())
    }

    /// The mechanism of a structure as TOML, and for an idea the options of its joints.
    ///
    /// # Errors
    /// Where there is none.
    pub fn mechanism(&self, id: &str) -> Stored<Option<String>> {
        let sql = "SELECT mechanism FROM layouts WHERE structure = ?1 \
                   UNION ALL SELECT mechanism FROM drawn WHERE id = ?1";
        let found = self.db.query_row(sql, [id], |r| r.get(0)).optional();
        self.ok(found)
    }

    /// What the first variant of an idea puts at each joint.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn choices(&self, id: &str, place: usize) -> Stored<Option<Vec<usize>>> {
        let sql = "SELECT choices FROM ideas WHERE structure = ?1 AND place = ?2";
        let place = i64::try_from(place).unwrap_or(i64::MAX);
        let found: Option<String> = self.ok(self
            .db
            .query_row(sql, params![id, place], |r| r.get(0))
            .optional())?;
        let number = |t: &str| t.parse().ok();
        Ok(found.and_then(|t| t.split(' ').map(number).collect()))
    }
}

/// A value of the database as one of JSON.
fn plain(value: ValueRef<'_>) -> Value {
    match value {
        ValueRef::Null => Value::Null,
        ValueRef::Integer(n) => n.into(),
        ValueRef::Real(x) => serde_json::Number::from_f64(x).map_or(Value::Null, Value::Number),
        ValueRef::Text(text) => String::from_utf8_lossy(text).into(),
        ValueRef::Blob(bytes) => format!("{} bytes", bytes.len()).into(),
    }
}
