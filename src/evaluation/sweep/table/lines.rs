//! Tables as files.

use super::error::TableError;
use super::head::Head;
use super::rows::{Table, line};
use crate::file::bounded;
use crate::shard::Digest;
use crate::sweep::row::SampleRow;
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

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
    rows: Vec<SampleRow>,
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
        let file = Output::wrap(path, open.open(path))?;
        if is_held(&file) {
            return Err(TableError::Busy(path.to_owned()));
        }
        let read = Lines::begun(path, &mut BufReader::new(&file), Some(head))?;
        let mut out = Output {
            path: path.to_owned(),
            file,
            digest: Digest::default(),
            rows: Vec::new(),
            finished: false,
        };
        let mut whole = 0;
        if let Some(read) = read {
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
    pub(super) fn there(&mut self) -> (Vec<SampleRow>, Digest) {
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

/// How often, and how long apart, a lock is asked for: a process that is just being started holds for a moment what its parent did.
const ASKED: (u32, Duration) = (10, Duration::from_millis(20));

/// Whether somebody else is at a file; otherwise it is locked.
fn is_held(file: &File) -> bool {
    for _ in 0..ASKED.0 {
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => std::thread::sleep(ASKED.1),
            // Not every file system has locks.
            Ok(()) | Err(TryLockError::Error(_)) => return false,
        }
    }
    true
}

/// No line of a table is longer, in bytes.
const LONGEST: usize = 1 << 26;

/// The lines of a table as far as they are whole.
struct Lines {
    head: Head,
    rows: Vec<SampleRow>,
    digest: Digest,
    finished: bool,
    /// Bytes up to the end of the last row.
    whole: usize,
}

impl Lines {
    /// Reads line by line, so that a file that is none is not read to its end. Nothing where there is no more than the beginning
    /// of the first line `of` a table that is to be made.
    fn begun(
        path: &Path,
        from: &mut impl BufRead,
        of: Option<&Head>,
    ) -> Result<Option<Lines>, TableError> {
        let other = || TableError::Other(path.to_owned());
        let first = match bounded::line(from, LONGEST) {
            Err(e) if e.kind() == io::ErrorKind::InvalidData => return Err(other()),
            done => Output::wrap(path, done)?,
        };
        if of.is_some_and(|head| !first.ends_with('\n') && line(head).starts_with(&first)) {
            return Ok(None);
        }
        let head: Head = serde_json::from_str(&first).map_err(|_| other())?;
        let mut out = Lines {
            head,
            rows: Vec::new(),
            digest: Digest::default(),
            finished: false,
            whole: first.len(),
        };
        loop {
            // What is no row is left of one that was being written.
            let text = match bounded::line(from, LONGEST) {
                Err(e) if e.kind() == io::ErrorKind::InvalidData => break,
                done => Output::wrap(path, done)?,
            };
            if !text.ends_with('\n') {
                break;
            }
            if let Ok(foot) = serde_json::from_str::<Foot>(&text) {
                if foot.rows != out.rows.len() || foot.digest != out.digest.hex() {
                    return Err(TableError::Spoilt(path.to_owned()));
                }
                out.finished = true;
                break;
            }
            let Ok(row) = serde_json::from_str::<SampleRow>(&text) else {
                break;
            };
            // Tables and drawings look each parameter up in each row.
            if !row.at.keys().eq(out.head.parameters.keys()) {
                let (path, sample) = (path.to_owned(), row.sample);
                return Err(TableError::Row { path, sample });
            }
            out.digest.add(&text);
            out.rows.push(row);
            out.whole += text.len();
        }
        Ok(Some(out))
    }
}

/// Reads a finished table.
///
/// # Errors
/// Where it is none, not finished, or was changed.
pub fn read(path: &Path) -> Result<Table, TableError> {
    let mut from = BufReader::new(Output::wrap(path, bounded::regular(path))?);
    let lines = Lines::begun(path, &mut from, None)?;
    let Some(lines) = lines.filter(|l| l.finished) else {
        return Err(TableError::Unfinished(path.to_owned()));
    };
    Ok(Table {
        head: lines.head,
        rows: lines.rows,
        finished: true,
        added: 0,
        digest: lines.digest,
    })
}
