//! The file of a catalogue: an SQLite database, a structure a transaction, so that it can be ended at any moment and
//! carried on.

mod held;
mod merge;
mod open;
pub(crate) mod version;

pub use held::Store;
pub use merge::Merged;

use crate::catalog::store::version::VERSION;
use std::path::PathBuf;
use thiserror::Error;

/// Size of an answer at most `[MiB]`: it is held whole, since columns are as wide as their widest value.
pub(crate) const LARGEST_ANSWER: usize = 256;

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
    /// The file is damaged: SQLite finds its pages inconsistent.
    #[error(
        "{0} is damaged ({why}): take a copy of it, or build it again under another name; `sqlite3 {0} .recover | sqlite3 NEW.db` saves \
         what can be read",
        path.display()
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What SQLite says of it.
        why: String,
    },
    /// The file is something else.
    #[error(
        "{} is not a catalogue of ozols; choose another name, `ozols catalog build -o NAME.db` makes one", .0.display()
    )]
    Other(PathBuf),
    /// Nothing is in it.
    #[error(
        "{} is empty: the command that was making the catalogue was ended; run it again and it carries on", .0.display()
    )]
    Empty(PathBuf),
    /// Tables of another version.
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
    /// A question that would do more than read the catalogue.
    #[error(
        "{}: a catalogue is only read here: no ATTACH, no VACUUM INTO, no settings; ask with SELECT, and -o FILE keeps the answer", .0.display()
    )]
    ReadOnly(PathBuf),
    /// A question with an answer that would fill the memory.
    #[error("{}: the answer is larger than {LARGEST_ANSWER} MiB; ask for fewer columns, or for a part of the rows with LIMIT and OFFSET", .0.display())]
    LargeAnswer(PathBuf),
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
