//! An open catalogue: what it holds, and what is added.

use crate::catalog::drawn::DrawnMechanism;
use crate::catalog::insert;
use crate::catalog::row::StructureRow;
use crate::catalog::store::version::{LARGEST_ANSWER, StoreError};
use rusqlite::types::ValueRef;
use rusqlite::{Connection, ErrorCode, OptionalExtension, TransactionBehavior, params};
use serde_json::Value;
use std::collections::BTreeSet;
use std::iter;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::time::{Duration, Instant};

/// An open catalogue.
#[derive(Debug)]
pub struct Store {
    pub(super) path: PathBuf,
    pub(super) db: Connection,
}

/// Rows that wait for the disk at most, and for how long: it takes as long for many as for one.
const WAITING: usize = 256;
const GATHERED: Duration = Duration::from_millis(500);

pub(super) type Stored<T> = Result<T, StoreError>;

impl Store {
    /// Returns what is wrong with a file, from what SQLite says.
    pub(super) fn error(path: &Path, why: rusqlite::Error) -> StoreError {
        let path = path.to_owned();
        match why.sqlite_error_code() {
            Some(ErrorCode::DatabaseCorrupt) => StoreError::Damaged {
                path,
                why: why.to_string(),
            },
            _ => StoreError::Database { path, why },
        }
    }

    pub(super) fn wrap<T>(path: &Path, result: rusqlite::Result<T>) -> Stored<T> {
        result.map_err(|why| Store::error(path, why))
    }

    pub(super) fn ok<T>(&self, result: rusqlite::Result<T>) -> Stored<T> {
        Store::wrap(&self.path, result)
    }

    pub(super) fn meta(&self, key: &str) -> Stored<Option<String>> {
        let sql = "SELECT value FROM meta WHERE key = ?1";
        let found = self.db.query_row(sql, [key], |r| r.get(0)).optional();
        self.ok(found)
    }

    pub(super) fn set_meta(&mut self, key: &str, value: &str) -> Stored<()> {
        let sql = "INSERT OR REPLACE INTO meta (key, value) VALUES (?1, ?2)";
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

    /// Adds structures with all that is known of them, at once or not at all.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn add(&mut self, rows: &[StructureRow]) -> Stored<()> {
        let mut all = || -> rusqlite::Result<()> {
            let t = (self.db).transaction_with_behavior(TransactionBehavior::Immediate)?;
            for row in rows {
                insert::row(&t, row)?;
            }
            t.commit()
        };
        let done = all();
        self.ok(done)
    }

    /// Adds structures while `make` makes them and sends them: those of half a second go together. Where the file cannot be written
    /// sending fails.
    ///
    /// # Errors
    /// Where the file cannot be written.
    ///
    /// # Panics
    /// Where `make` does.
    pub fn add_while<R>(&mut self, make: impl FnOnce(SyncSender<StructureRow>) -> R) -> Stored<R> {
        let (send, made) = sync_channel(WAITING);
        std::thread::scope(|scope| {
            let writer = scope.spawn(move || -> Stored<()> {
                while let Ok(first) = made.recv() {
                    let until = Instant::now() + GATHERED;
                    let more = || {
                        let left = until.saturating_duration_since(Instant::now());
                        made.recv_timeout(left).ok()
                    };
                    let all = iter::once(first).chain(iter::from_fn(more));
                    let all: Vec<_> = all.take(WAITING).collect();
                    self.add(&all)?;
                }
                Ok(())
            });
            let out = make(send);
            match writer.join() {
                Ok(written) => written.map(|()| out),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        })
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
    pub fn add_drawn(&mut self, drawn: &DrawnMechanism) -> Stored<()> {
        let mut all = || -> rusqlite::Result<()> {
            let t = (self.db).transaction_with_behavior(TransactionBehavior::Immediate)?;
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
    /// Where the question is wrong, is none, or has too large an answer.
    pub fn query(&self, sql: &str, id: Option<&str>) -> Stored<(Vec<String>, Vec<Vec<Value>>)> {
        let all = || -> rusqlite::Result<_> {
            let mut query = self.db.prepare(sql)?;
            let names: Vec<String> = query
                .column_names()
                .into_iter()
                .map(str::to_owned)
                .collect();
            let (mut rows, mut bytes) = (Vec::new(), 0);
            let mut found = query.query(rusqlite::params_from_iter(id))?;
            while let Some(r) = found.next()? {
                let row = (0..names.len()).map(|i| Ok(plain(r.get_ref(i)?)));
                let row: Vec<Value> = row.collect::<rusqlite::Result<_>>()?;
                bytes += row.iter().map(held_by).sum::<usize>();
                if bytes > LARGEST_ANSWER << 20 {
                    return Ok(Err(StoreError::LargeAnswer(self.path.clone())));
                }
                rows.push(row);
            }
            Ok(Ok((names, rows)))
        };
        let only_read = || StoreError::ReadOnly(self.path.clone());
        match all() {
            // BEGIN and the like are no questions.
            Ok(Ok((names, _))) if names.is_empty() => Err(only_read()),
            Err(why)
                if why.sqlite_error_code() == Some(ErrorCode::AuthorizationForStatementDenied) =>
            {
                Err(only_read())
            }
            done => self.ok(done)?,
        }
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

/// About the bytes that a value takes.
fn held_by(value: &Value) -> usize {
    size_of::<Value>() + value.as_str().map_or(0, str::len)
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
