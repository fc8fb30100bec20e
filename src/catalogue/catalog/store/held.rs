//! An open catalogue: reading and adding rows.

use crate::catalog::insert;
use crate::catalog::row::StructureRow;
use crate::catalog::store::version::{LARGEST_ANSWER, StoreError};
use rusqlite::types::{FromSql, ValueRef};
use rusqlite::{
    Connection, ErrorCode, OptionalExtension, Params, Transaction, TransactionBehavior, params,
};
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

/// Maximum number of rows that wait for the disk, and their waiting time. Writing many takes as long as writing one.
const WAITING: usize = 256;
const GATHERED: Duration = Duration::from_millis(500);

pub(super) type Stored<T> = Result<T, StoreError>;

impl Store {
    /// Returns the fault of a file from SQLite's error.
    pub(super) fn wrap_error(path: &Path, why: rusqlite::Error) -> StoreError {
        let path = path.to_owned();
        match why.sqlite_error_code() {
            Some(ErrorCode::DatabaseCorrupt) => StoreError::Damaged {
                path,
                why: why.to_string(),
            },
            _ => StoreError::Database { path, why },
        }
    }

    pub(super) fn wrap_result<T>(path: &Path, result: rusqlite::Result<T>) -> Stored<T> {
        result.map_err(|why| Store::wrap_error(path, why))
    }

    pub(super) fn check_result<T>(&self, result: rusqlite::Result<T>) -> Stored<T> {
        Store::wrap_result(&self.path, result)
    }

    /// Returns the first column of an answer.
    pub(super) fn column(&self, sql: &str, of: impl Params) -> Stored<Vec<String>> {
        let read = || {
            let mut query = self.db.prepare(sql)?;
            query.query_map(of, |r| r.get(0))?.collect()
        };
        self.check_result(read())
    }

    /// Returns the first value of an answer, or `None` if it has no row.
    fn value<T: FromSql>(&self, sql: &str, of: impl Params) -> Stored<Option<T>> {
        self.check_result(self.db.query_row(sql, of, |r| r.get(0)).optional())
    }

    /// Executes a statement that modifies the file.
    pub(super) fn change(&self, sql: &str, of: impl Params) -> Stored<()> {
        self.check_result(self.db.execute(sql, of)).map(drop)
    }

    /// Modifies the file in one transaction: completely, or not at all.
    fn transact(
        &mut self,
        change: impl FnOnce(&Transaction<'_>) -> rusqlite::Result<()>,
    ) -> Stored<()> {
        let begun = (self.db).transaction_with_behavior(TransactionBehavior::Immediate);
        let done = begun.and_then(|t| change(&t).and_then(|()| t.commit()));
        self.check_result(done)
    }

    pub(super) fn meta_value(&self, key: &str) -> Stored<Option<String>> {
        self.value("SELECT value FROM meta WHERE key = ?1", [key])
    }

    pub(super) fn set_meta(&mut self, key: &str, value: &str) -> Stored<()> {
        let sql = "INSERT OR REPLACE INTO meta (key, value) VALUES (?1, ?2)";
        self.change(sql, [key, value])
    }

    /// Returns the ids of the stored structures.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read.
    pub fn structure_ids(&self) -> Stored<BTreeSet<String>> {
        let all = self.column("SELECT id FROM structures", [])?;
        Ok(all.into_iter().collect())
    }

    /// Adds structures with all their data, completely or not at all.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn add_rows(&mut self, rows: &[StructureRow]) -> Stored<()> {
        self.transact(|t| {
            rows.iter()
                .try_for_each(|row| insert::insert_structure(t, row))
        })
    }

    /// Adds structures while `make` makes and sends them, those of half a second together. If the file cannot be written, sending
    /// fails.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    ///
    /// # Panics
    /// Panics if `make` does.
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
                    self.add_rows(&all)?;
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

    /// Returns the whole id, given its beginning.
    ///
    /// # Errors
    /// Returns an error if there is no such id, or several.
    pub fn find_id(&self, id: &str) -> Stored<String> {
        let sql = "SELECT id FROM structures WHERE substr(id, 1, length(?1)) = ?1 OR name = ?1 ORDER BY id";
        let found = self.column(sql, [id])?;
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

    /// Returns the answer to a query in SQL as names of columns and rows; `?1` is `id`.
    ///
    /// # Errors
    /// Returns an error if the query is invalid or its answer is too large.
    pub fn query_rows(
        &self,
        sql: &str,
        id: Option<&str>,
    ) -> Stored<(Vec<String>, Vec<Vec<Value>>)> {
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
                let row = (0..names.len()).map(|i| Ok(json_value(r.get_ref(i)?)));
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
            // BEGIN and similar statements are not queries.
            Ok(Ok((names, _))) if names.is_empty() => Err(only_read()),
            Err(why)
                if why.sqlite_error_code() == Some(ErrorCode::AuthorizationForStatementDenied) =>
            {
                Err(only_read())
            }
            done => self.check_result(done)?,
        }
    }

    /// Returns the mechanism of a structure as TOML.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read.
    pub fn mechanism_text(&self, id: &str) -> Stored<Option<String>> {
        let sql = "SELECT mechanism FROM layouts WHERE structure = ?1";
        self.value(sql, [id])
    }

    /// Returns the option of each joint in the first variant of an idea.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read.
    pub fn idea_choices(&self, id: &str, place: usize) -> Stored<Option<Vec<usize>>> {
        let sql = "SELECT choices FROM ideas WHERE structure = ?1 AND place = ?2";
        let place = i64::try_from(place).unwrap_or(i64::MAX);
        let found = self.value::<String>(sql, params![id, place])?;
        let number = |t: &str| t.parse().ok();
        Ok(found.and_then(|t| t.split(' ').map(number).collect()))
    }
}

/// Returns the approximate number of bytes of a value.
fn held_by(value: &Value) -> usize {
    size_of::<Value>() + value.as_str().map_or(0, str::len)
}

/// Converts a value of the database to JSON.
fn json_value(value: ValueRef<'_>) -> Value {
    match value {
        ValueRef::Null => Value::Null,
        ValueRef::Integer(n) => n.into(),
        ValueRef::Real(x) => serde_json::Number::from_f64(x).map_or(Value::Null, Value::Number),
        ValueRef::Text(text) => String::from_utf8_lossy(text).into(),
        ValueRef::Blob(bytes) => format!("{} bytes", bytes.len()).into(),
    }
}
