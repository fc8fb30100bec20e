//! Files on the disk, read only up to a bound; all files of any size are read in this way. Each is recorded as read.
//!
//! The module knows which file a name refers to, and which files were read, so that a command does not overwrite its input.

use std::collections::BTreeSet;
use std::fs::{self, File, Metadata};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Returns the bytes of a file, at most one more than `limit`, so that the caller can report that there are too many.
///
/// # Errors
/// Returns an error if it is not a regular file, or cannot be read.
pub fn read_bytes(path: &Path, limit: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path)?
        .take(limit as u64 + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Returns the bytes of a file, and an error if there are more than `limit`.
///
/// # Errors
/// Returns an error if it is not a regular file, is longer, or cannot be read.
///
/// # Examples
/// ```
/// use ozols::file::disk::at_most;
/// let path = std::env::temp_dir().join("ozols-at-most.toml");
/// std::fs::write(&path, "name = \"mine\"")?;
/// assert_eq!(at_most(&path, 100)?.len(), 13);
/// assert!(at_most(&path, 12).is_err());
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn at_most(path: &Path, limit: usize) -> io::Result<Vec<u8>> {
    let all = read_bytes(path, limit)?;
    if all.len() > limit {
        let message = format!("it has more than the {limit} bytes allowed");
        return Err(io::Error::new(ErrorKind::InvalidData, message));
    }
    Ok(all)
}

/// Returns the text of a file.
///
/// # Errors
/// Returns the errors of [`at_most`], and an error if it is not UTF-8.
pub fn read_text(path: &Path, limit: usize) -> io::Result<String> {
    let text = String::from_utf8(at_most(path, limit)?);
    text.map_err(|_| io::Error::new(ErrorKind::InvalidData, "it is not UTF-8 text"))
}

/// Opens a regular file; rejects files that never end or that block when opened.
///
/// # Errors
/// Returns an error if it is not a regular file, or cannot be opened.
pub fn open_regular(path: &Path) -> io::Result<File> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    note_read(path);
    File::open(path)
}

/// A file, identified independently of its name if possible.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum FileId {
    /// Its device and inode number, which only Unix systems report.
    Number(u64, u64),
    /// Its whole path, without links.
    Path(PathBuf),
}

/// The files that were read since [`forget_read`].
static READ: Mutex<BTreeSet<FileId>> = Mutex::new(BTreeSet::new());

fn files_read() -> MutexGuard<'static, BTreeSet<FileId>> {
    READ.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the identity of a file: a name may be given to another file while the first is still read.
fn file_ids(path: &Path) -> impl Iterator<Item = FileId> {
    let number = fs::metadata(path).ok().and_then(|m| file_number(&m));
    let path = fs::canonicalize(path).ok().map(FileId::Path);
    number.into_iter().chain(path)
}

#[cfg(unix)]
fn file_number(of: &Metadata) -> Option<FileId> {
    use std::os::unix::fs::MetadataExt;
    of.is_file().then(|| FileId::Number(of.dev(), of.ino()))
}

#[cfg(not(unix))]
fn file_number(_: &Metadata) -> Option<FileId> {
    None
}

/// Forgets the files that were read.
pub fn forget_read() {
    files_read().clear();
}

/// Adds a file to those that were read.
pub fn note_read(path: &Path) {
    files_read().extend(file_ids(path));
}

/// Adds an open file to those that were read.
pub fn note_open(file: &Metadata) {
    files_read().extend(file_number(file));
}

/// Returns true if a file was read, under this or another name.
#[must_use]
pub fn was_read(path: &Path) -> bool {
    let read = files_read();
    file_ids(path).any(|id| read.contains(&id))
}

/// Returns whether an open file was read.
#[must_use]
pub fn open_was_read(file: &Metadata) -> bool {
    file_number(file).is_some_and(|id| files_read().contains(&id))
}

/// Returns whether an open file is the one that a path leads to.
#[must_use]
pub fn is_at(file: &Metadata, path: &Path) -> bool {
    let id = file_number(file);
    id.is_some() && id == fs::metadata(path).ok().and_then(|m| file_number(&m))
}
