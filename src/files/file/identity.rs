//! Which file a name stands for, and which files were read: what a command reads is not written over by it.

use std::collections::BTreeSet;
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A file, by whatever name.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum FileId {
    /// Its device and its number there, which systems that are no Unix do not tell.
    Number(u64, u64),
    /// Its whole path, without links.
    Path(PathBuf),
}

/// The files that were read since [`forget`].
static READ: Mutex<BTreeSet<FileId>> = Mutex::new(BTreeSet::new());

fn read() -> MutexGuard<'static, BTreeSet<FileId>> {
    READ.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns what a file is known by: a name may be given to another file while the first is still read.
fn ids(path: &Path) -> impl Iterator<Item = FileId> {
    let number = fs::metadata(path).ok().and_then(|m| number(&m));
    let path = fs::canonicalize(path).ok().map(FileId::Path);
    number.into_iter().chain(path)
}

#[cfg(unix)]
fn number(of: &Metadata) -> Option<FileId> {
    use std::os::unix::fs::MetadataExt;
    of.is_file().then(|| FileId::Number(of.dev(), of.ino()))
}

#[cfg(not(unix))]
fn number(_: &Metadata) -> Option<FileId> {
    None
}

/// Forgets what was read.
pub fn forget() {
    read().clear();
}

/// Adds a file to those that were read.
pub fn note(path: &Path) {
    read().extend(ids(path));
}

/// Adds an open file to those that were read.
pub fn note_open(file: &Metadata) {
    read().extend(number(file));
}

/// Returns whether a file was read, by whatever name.
#[must_use]
pub fn was_read(path: &Path) -> bool {
    let read = read();
    ids(path).any(|id| read.contains(&id))
}

/// Returns whether an open file was read.
#[must_use]
pub fn open_was_read(file: &Metadata) -> bool {
    number(file).is_some_and(|id| read().contains(&id))
}

/// Returns whether an open file is the one that a path leads to.
#[must_use]
pub fn is_at(file: &Metadata, path: &Path) -> bool {
    let id = number(file);
    id.is_some() && id == fs::metadata(path).ok().and_then(|m| number(&m))
}
