//! The table of a sweep: JSON lines, first what was asked, then a row a sample in order of the samples, then how many rows there
//! are and their digest.
//!
//! Rows are added at the end as they are made, so that a table that was ended at any moment is the beginning of the whole one,
//! and is carried on. Its bytes depend on nothing but the sweep and the part.

use crate::file::read::parameters::Domain;
use crate::shard::{Digest, Shard};
use crate::sweep::redesigns::as_searched;
use crate::sweep::row::Row;
use crate::sweep::space::{Axis, Sampling};
use crate::sweep::{Sweep, SweepError};
use itertools::Itertools;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Version of the lines.
const VERSION: u32 = 1;

/// What a table is of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    /// Name of the mechanism.
    pub sweep: String,
    /// Version of the lines.
    pub version: u32,
    /// Version of the program.
    pub ozols: String,
    /// SHA-256 of the mechanism file.
    pub file: String,
    /// What each parameter may be, the ends of its range or its values.
    pub parameters: BTreeMap<String, Vec<String>>,
    /// Numbers of the grid along each parameter, or of the sequence.
    pub sampling: String,
    /// What is found out beside mobility and redundant constraints.
    pub asked: String,
    /// Samples of all parts.
    pub samples: usize,
    /// Which part, such as `1/1`.
    pub shard: String,
}

/// The last line.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Foot {
    rows: usize,
    digest: String,
}

/// A table that was read or made.
#[derive(Debug, Clone)]
pub struct Table {
    /// What it is of.
    pub head: Head,
    /// The rows, by number of their samples.
    pub rows: Vec<Row>,
    /// Whether it has all of its rows.
    pub finished: bool,
    /// How many rows were added now.
    pub added: usize,
    /// The digest of its rows, as they stand in the file.
    pub digest: Digest,
}

/// What is wrong with a table.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableError {
    /// The file cannot be read or written.
    #[error("{}: {why}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why not.
        why: io::Error,
    },
    /// Somebody else is at it.
    #[error("{} is being written by another process; wait for it, or choose another name", .0.display())]
    Busy(PathBuf),
    /// It is something else.
    #[error("{} is no table of a sweep; choose another name, `ozols sweep FILE -o NAME.jsonl` makes one", .0.display())]
    Other(PathBuf),
    /// It is of another sweep.
    #[error("{} is of another sweep ({what} differs: {there} there, {asked} asked for); choose another name, or the same sweep", path.display())]
    Differs {
        /// The file.
        path: PathBuf,
        /// Which part of the head.
        what: &'static str,
        /// What it holds.
        there: String,
        /// What is asked.
        asked: String,
    },
    /// It ends early.
    #[error("{} is not finished; the command that made it carries on", .0.display())]
    Unfinished(PathBuf),
    /// Its rows are not those that were written.
    #[error("{} was changed: its rows do not have the digest of its last line; make it again", .0.display())]
    Spoilt(PathBuf),
    /// A part is missing or there twice.
    #[error("the parts do not make the whole: {0}")]
    Parts(String),
    /// No sweep.
    #[error(transparent)]
    Sweep(#[from] SweepError),
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

impl Head {
    /// What the table of a part of a sweep is of.
    #[must_use]
    pub fn new(sweep: &Sweep, shard: Shard) -> Head {
        let spec = &sweep.spec;
        let domain = |a: &Axis| match &a.domain {
            Domain::Range([from, to]) => vec![format!("from {from}"), format!("to {to}")],
            Domain::Values(_) | Domain::Constant => {
                a.grid.iter().map(ToString::to_string).collect()
            }
        };
        let sizes = || sweep.space.axes.iter().map(|a| a.grid.len()).join(" x ");
        let asked = &spec.asked;
        let search = asked.search.as_ref().map(|r| {
            let all = format!("{:?}", as_searched(r, 0));
            format!("search {}", &hex(&Sha256::digest(all))[..16])
        });
        let stroke = asked
            .stroke
            .as_ref()
            .map(|(text, _)| format!("stroke {text}"));
        let methods = asked.methods.then(|| "methods".to_owned());
        let top = format!("top {}", asked.top);
        let written = asked.as_written.then(|| "as written".to_owned());
        let asked = [
            search.map(|s| format!("{s}, {top}")),
            stroke,
            methods,
            written,
        ];
        Head {
            sweep: sweep.mechanism.clone(),
            version: VERSION,
            ozols: env!("CARGO_PKG_VERSION").to_owned(),
            file: hex(&Sha256::digest(&spec.text)),
            parameters: sweep
                .space
                .axes
                .iter()
                .map(|a| (a.name.clone(), domain(a)))
                .collect(),
            sampling: match spec.sampling {
                Sampling::Grid { .. } => format!("grid {}", sizes()),
                Sampling::Sobol { count, seed } => format!("sobol {count}, seed {seed}"),
            },
            asked: asked.into_iter().flatten().join("; "),
            samples: sweep.space.len(),
            shard: shard.to_string(),
        }
    }

    /// Where it differs from another, but for the part.
    fn differs(&self, asked: &Head) -> Option<(&'static str, String, String)> {
        let words = |h: &Head| {
            [
                ("the mechanism", h.sweep.clone()),
                ("the file", h.file[..h.file.len().min(12)].to_owned()),
                ("the sampling", h.sampling.clone()),
                ("the parameters", format!("{:?}", h.parameters)),
                ("what is asked", h.asked.clone()),
                ("the version", format!("{} of ozols {}", h.version, h.ozols)),
            ]
        };
        let mut both = words(self).into_iter().zip(words(asked));
        both.find(|(a, b)| a != b)
            .map(|((what, there), (_, asked))| (what, there, asked))
    }
}

/// Says how far a sweep has come, samples done and in all; and whether to end early.
pub trait Watch {
    /// Hears how far.
    fn done(&mut self, done: usize, of: usize);
    /// Whether to end.
    fn ended(&self) -> bool;
}

/// Makes what a table lacks of a part, or all of it in memory where there is no file. What was whole stays as it is.
///
/// # Errors
/// Where the file cannot be written, or is something else.
///
/// # Complexity
/// That of the rows, which are made in parallel; memory for all of them.
pub fn make(
    sweep: &Sweep,
    shard: Shard,
    path: Option<&Path>,
    watch: &mut (dyn Watch + Send),
) -> Result<Table, TableError> {
    let head = Head::new(sweep, shard);
    let mut out = match path {
        Some(path) => Some(Output::open(path, &head)?),
        None => None,
    };
    let (rows, digest) = out.as_mut().map(Output::there).unwrap_or_default();
    let mut table = Table {
        finished: out.as_ref().is_some_and(|o| o.finished),
        added: 0,
        head,
        rows,
        digest,
    };
    if table.finished {
        return Ok(table);
    }
    let all = 0..sweep.space.len();
    let own: Vec<usize> = match shard {
        Shard::WHOLE => all.collect(),
        part => all
            .into_par_iter()
            .filter(|&n| part.has(&sweep.space.sample(n).name()))
            .collect(),
    };
    if !table
        .rows
        .iter()
        .map(|r| r.sample)
        .eq(own.iter().copied().take(table.rows.len()))
    {
        return Err(TableError::Spoilt(path.unwrap_or(Path::new("")).to_owned()));
    }
    // As many at a time as keep all threads at it; what is written does not depend on it.
    let chunk = 4 * rayon::current_num_threads();
    for numbers in own[table.rows.len()..].chunks(chunk) {
        if watch.ended() {
            return Ok(table);
        }
        let each = numbers.par_iter();
        let rows: Vec<Row> = each.map(|&n| sweep.row(&sweep.space.sample(n))).collect();
        let text = table.add(rows);
        if let Some(out) = &mut out {
            out.add(&text)?;
        }
        watch.done(table.rows.len(), own.len());
    }
    if let Some(out) = &mut out {
        out.finish(&table.digest)?;
    }
    table.finished = true;
    Ok(table)
}

impl Table {
    /// Takes in rows; their lines.
    fn add(&mut self, rows: Vec<Row>) -> String {
        let mut text = String::new();
        for row in &rows {
            let line = line(row);
            self.digest.add(&line);
            text += &line;
        }
        self.added += rows.len();
        self.rows.extend(rows);
        text
    }
}

/// A table that is being written.
struct Output {
    path: PathBuf,
    file: File,
    digest: Digest,
    rows: Vec<Row>,
    finished: bool,
}

fn line(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default() + "\n"
}

impl Output {
    fn wrap<T>(path: &Path, done: io::Result<T>) -> Result<T, TableError> {
        done.map_err(|why| TableError::File {
            path: path.to_owned(),
            why,
        })
    }

    /// Opens a table to carry on, or begins one.
    fn open(path: &Path, head: &Head) -> Result<Output, TableError> {
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
    fn there(&mut self) -> (Vec<Row>, Digest) {
        (std::mem::take(&mut self.rows), self.digest.clone())
    }

    fn add(&mut self, lines: &str) -> Result<(), TableError> {
        Output::wrap(&self.path, self.file.write_all(lines.as_bytes()))
    }

    fn finish(&mut self, digest: &Digest) -> Result<(), TableError> {
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

/// Puts the parts of a sweep together; every part must be there once, whole and of the same sweep. The table is, byte for byte,
/// the one that is made at once, and appears under its name once it is complete.
///
/// # Errors
/// Where a part is missing, not finished, changed or of another sweep, or the whole cannot be written.
pub fn merge(parts: &[PathBuf], whole: &Path) -> Result<Table, TableError> {
    let mut all: Option<Table> = None;
    let mut seen: Vec<(u64, u64)> = Vec::new();
    for path in parts {
        let part = read(path)?;
        let of: Shard = part
            .head
            .shard
            .parse()
            .map_err(|_| TableError::Other(path.clone()))?;
        seen.push((of.index, of.of));
        match &mut all {
            None => all = Some(part),
            Some(all) => {
                if let Some((what, there, asked)) = part.head.differs(&all.head) {
                    let path = path.clone();
                    return Err(TableError::Differs {
                        path,
                        what,
                        there,
                        asked,
                    });
                }
                all.rows.extend(part.rows);
            }
        }
    }
    let fail = |why: String| TableError::Parts(why);
    let mut all = all.ok_or_else(|| fail("there are none".to_owned()))?;
    let of = seen[0].1;
    let (missing, twice) = (
        (0..of).find(|i| !seen.contains(&(*i, of))),
        seen.iter().duplicates().next(),
    );
    match (missing, twice, seen.iter().find(|s| s.1 != of)) {
        (.., Some(other)) => {
            let why = format!("one is of {of}, another of {}", other.1);
            return Err(fail(why));
        }
        (_, Some((i, of)), _) => return Err(fail(format!("{}/{of} is there twice", i + 1))),
        (Some(i), ..) => return Err(fail(format!("{}/{of} is missing", i + 1))),
        (None, None, None) => {}
    }
    all.rows.sort_by_key(|r| r.sample);
    if !all.rows.iter().map(|r| r.sample).eq(0..all.head.samples) {
        return Err(fail("some samples are missing".to_owned()));
    }
    all.head.shard = Shard::WHOLE.to_string();
    let rows = std::mem::take(&mut all.rows);
    all.digest = Digest::default();
    let text = all.add(rows);
    let mut beside = whole.as_os_str().to_owned();
    beside.push(format!(".{}.tmp", std::process::id()));
    let beside = PathBuf::from(beside);
    let written = Output::open(&beside, &all.head).and_then(|mut out| {
        out.add(&text)?;
        out.finish(&all.digest)
    });
    let placed = written.and_then(|()| Output::wrap(whole, std::fs::rename(&beside, whole)));
    if placed.is_err() {
        let _ = std::fs::remove_file(&beside);
    }
    placed.map(|()| all)
}
