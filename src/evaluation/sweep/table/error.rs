//! What is wrong with a table.

use crate::sweep::SweepError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

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
    #[error("{} is not a table of a sweep; choose another name, `ozols sweep FILE -o NAME.jsonl` makes one", .0.display())]
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
    /// A row that is of other parameters than the first line.
    #[error("{} was changed: sample {sample} has other parameters than its first line; make it again", path.display())]
    Row {
        /// The file.
        path: PathBuf,
        /// The sample.
        sample: usize,
    },
    /// A part is missing or there twice.
    #[error("the parts do not make the whole: {0}")]
    Parts(String),
    /// No sweep.
    #[error(transparent)]
    Sweep(#[from] SweepError),
}
