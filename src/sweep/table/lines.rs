//! Tables as files.

use super::error::TableError;
use super::head::Head;
use super::rows::{Table, line};
use crate::shard::Digest;
use crate::sweep::row::Row;
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The last line.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Foot {
    rows: usize,
    digest: String,
}

/// A table that is being written.
pub(super) struct Output {
    path: PathBuf,
    file: File,
    digest: Digest,
    rows: Vec<Row>,
    /// Whether it was whole already.
    pub(super) finished: bool,
}

impl Output {
    pub(super) fn wrap<T>(path: &Path, done: io::Result<T>) -> Result<T, TableError> {
        done.map_err(|why| TableError::File {
            path: path.to_owned(),
            why,
        })
    }

    /// Opens a table to carry on, or begins one.
    pub(super) fn open(path: &Path, head: &Head) -> Result<Output, TableError> {
        let ok = |done: io::Result<()>| Output::wrap(path, done);
        let mut open = OpenOptions::new();
        open.read(true).write(true).create(true).truncate(false);
        let mut file = Output::wrap(path, open.open(path))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(TableError::Busy(path.to_owned())),
            // Not every file system has locks.
            Err(TryLockError::Error(_)) => {}
        }
        let mut text = String::new();
        match file.read_to_string(&mut text) {
            Err(e) if e.kind() == io::ErrorKind::InvalidData => {
                return Err(TableError::Other(path.to_owned()));
            }
            done => ok(done.map(drop))?,
        }
        let mut out = Output {
            path: path.to_owned(),
            file,
            digest: Digest::default(),
            rows: Vec::new(),
            finished: false,
        };
        let mut whole = 0;
        if !text.is_empty() && !is_beginning(&text, head) {
            let read = Lines::read(path, &text)?;
            if let Some((what, there, asked)) = read.head.differs(head) {
                let path = path.to_owned();
                return Err(TableError::Differs {
                    path,
                    what,
                    there,
                    asked,
                });
            }
            if read.head.shard != head.shard {
                return Err(TableError::Differs {
                    path: path.to_owned(),
                    what: "the part",
                    there: read.head.shard,
                    asked: head.shard.clone(),
                });
            }
            (whole, out.digest, out.rows) = (read.whole, read.digest, read.rows);
            out.finished = read.finished;
        }
        if out.finished {
            return Ok(out);
        }
        // What is left of a row that was being written.
        ok(out.file.set_len(whole as u64))?;
        ok(out.file.seek(SeekFrom::End(0)).map(drop))?;
        if whole == 0 {
            ok(out.file.write_all(line(head).as_bytes()))?;
        }
        Ok(out)
    }

    /// The rows that were there, and their digest.
    pub(super) fn there(&mut self) -> (Vec<Row>, Digest) {
        (std::mem::take(&mut self.rows), self.digest.clone())
    }

    /// Writes lines at the end.
    pub(super) fn add(&mut self, lines: &str) -> Result<(), TableError> {
        Output::wrap(&self.path, self.file.write_all(lines.as_bytes()))
    }

    /// Writes the last line.
    pub(super) fn finish(&mut self, digest: &Digest) -> Result<(), TableError> {
        let foot = Foot {
            rows: digest.rows,
            digest: digest.hex(),
        };
        let done = self.file.write_all(line(&foot).as_bytes());
        Output::wrap(&self.path, done.and_then(|()| self.file.sync_all()))
    }
}

/// Whether a text is no more than the beginning of a first line.
fn is_beginning(text: &str, head: &Head) -> bool {
    !text.contains('\n') && line(head).starts_with(text)
}

/// The lines of a table as far as they are whole.
struct Lines {
    head: Head,
    rows: Vec<Row>,
    digest: Digest,
    finished: bool,
    /// Bytes up to the end of the last row.
    whole: usize,
}

impl Lines {
    fn read(path: &Path, text: &str) -> Result<Lines, TableError> {
        let mut lines = text.split_inclusive('\n');
        let first = lines.next().unwrap_or_default();
        let other = || TableError::Other(path.to_owned());
        let head: Head = serde_json::from_str(first).map_err(|_| other())?;
        let mut out = Lines {
            head,
            rows: Vec::new(),
            digest: Digest::default(),
            finished: false,
            whole: first.len(),
        };
        for text in lines {
            if !text.ends_with('\n') {
                break;
            }
            if let Ok(foot) = serde_json::from_str::<Foot>(text) {
                if foot.rows != out.rows.len() || foot.digest != out.digest.hex() {
                    return Err(TableError::Spoilt(path.to_owned()));
                }
                out.finished = true;
                return Ok(out);
            }
            let Ok(row) = serde_json::from_str(text) else {
                break;
            };
            out.digest.add(text);
            out.rows.push(row);
            out.whole += text.len();
        }
        Ok(out)
    }
}

/// Reads a finished table.
///
/// # Errors
/// Where it is none, not finished, or was changed.
pub fn read(path: &Path) -> Result<Table, TableError> {
    let text = match std::fs::read_to_string(path) {
        Err(e) if e.kind() == io::ErrorKind::InvalidData => {
            return Err(TableError::Other(path.to_owned()));
        }
        done => Output::wrap(path, done)?,
    };
    let lines = Lines::read(path, &text)?;
    if !lines.finished {
        return Err(TableError::Unfinished(path.to_owned()));
    }
    Ok(Table {
        head: lines.head,
        rows: lines.rows,
        finished: true,
        added: 0,
        digest: lines.digest,
    })
}
