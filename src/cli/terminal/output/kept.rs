//! Protection of inputs and earlier outputs from being overwritten, and temporary files next to the files they replace, so that these
//! are either complete or unchanged.

use crate::api::folder_of;
use crate::file::disk;
use crate::studio;
use anyhow::ensure;
use itertools::Itertools;
use std::ffi::OsString;
use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;

/// The files that were written, by their places.
static WRITTEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
/// The first bytes of a SQLite database.
const DATABASE: [u8; 16] = *b"SQLite format 3\0";

fn lock_written() -> MutexGuard<'static, Vec<PathBuf>> {
    WRITTEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Forgets what was read and written: a command begins.
pub(crate) fn forget_files() {
    disk::forget_read();
    lock_written().clear();
}

/// Keeps a file that is read by others than this program's own reader.
pub(crate) fn keep_file(path: &Path) {
    disk::note_read(path);
}

/// Keeps standard input if it is a file.
///
/// # Errors
/// Returns an error if standard output is the same file.
pub(crate) fn keep_standard_input() -> anyhow::Result<()> {
    if let Some(file) = standard_file(io::stdin()) {
        disk::note_open(&file);
    }
    apart_from_standard_output()
}

/// Returns true if a file is protected, under any name.
pub(crate) fn is_kept(path: &Path) -> bool {
    disk::was_read(path)
}

/// Refuses outputs, each with the name of its option, of which one would take the place of another.
pub(crate) fn ensure_distinct(outputs: &[(&str, PathBuf)]) -> anyhow::Result<()> {
    let to_standard = standard_file(io::stdout());
    for (option, path) in outputs {
        let shown = path.display();
        let same = to_standard
            .as_ref()
            .is_some_and(|file| disk::is_at(file, path));
        ensure!(
            !same,
            "--{option} {shown} is also standard output, and one would overwrite the other; name another file"
        );
    }
    for ((one, first), (other, second)) in outputs.iter().tuple_combinations() {
        let shown = second.display();
        ensure!(
            is_device(first) || canonical_path(first) != canonical_path(second),
            "--{one} and --{other} both write {shown}, and one would overwrite the other; name two files"
        );
    }
    Ok(())
}

/// Returns the whole path of a file that exists or will be made, without links.
fn canonical_path(path: &Path) -> PathBuf {
    let folder = || fs::canonicalize(folder_of(path)).ok();
    let new = || Some(folder()?.join(path.file_name()?));
    let there = fs::canonicalize(path).ok();
    there.or_else(new).unwrap_or_else(|| path.to_path_buf())
}

/// Returns true if a path is a pipe or terminal, which stores nothing.
fn is_device(path: &Path) -> bool {
    path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// Refuses to write over what is kept, over a catalogue, and over what this command has written already.
pub(crate) fn ensure_apart(path: &Path) -> anyhow::Result<()> {
    let name = path.display();
    ensure!(
        !is_kept(path),
        "{name} is the input; name another file to write"
    );
    ensure!(
        !is_database(path),
        "{name} is a catalogue or another database; name another file to write"
    );
    ensure!(
        is_device(path) || !lock_written().contains(&canonical_path(path)),
        "{name} was already written by this command and would be overwritten; name two files"
    );
    Ok(())
}

/// Records that a file was written.
pub(super) fn note_written(path: &Path) {
    lock_written().push(canonical_path(path));
}

/// Refuses to write to standard output where it is a file that is read.
pub(super) fn apart_from_standard_output() -> anyhow::Result<()> {
    let same = standard_file(io::stdout()).is_some_and(|file| disk::open_was_read(&file));
    ensure!(
        !same,
        "standard output is the input file; send it to another file"
    );
    Ok(())
}

/// Returns the metadata of standard input or output if it is a file.
#[cfg(unix)]
fn standard_file(stream: impl std::os::fd::AsFd) -> Option<Metadata> {
    let file = File::from(stream.as_fd().try_clone_to_owned().ok()?);
    file.metadata().ok().filter(Metadata::is_file)
}

/// Returns nothing: this system does not tell which file it is.
#[cfg(not(unix))]
fn standard_file<T>(_: T) -> Option<Metadata> {
    None
}

fn is_database(path: &Path) -> bool {
    let mut head = [0; DATABASE.len()];
    // A pipe would wait for what nobody writes.
    let begins = |mut f: File| f.read_exact(&mut head).is_ok() && head == DATABASE;
    path.is_file() && File::open(path).is_ok_and(begins)
}

/// The file that is being written, which is removed if the program ends before it is complete.
static BESIDE: Mutex<Option<PathBuf>> = Mutex::new(None);

fn lock_beside() -> MutexGuard<'static, Option<PathBuf>> {
    BESIDE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// True if the current output may be incomplete.
static CUT: AtomicBool = AtomicBool::new(false);

/// Marks all further output as incomplete.
pub(crate) fn cut_short() {
    CUT.store(true, Ordering::SeqCst);
}

/// Removes the file that is being written, if one is.
pub(crate) fn remove_unfinished() {
    if let Some(path) = lock_beside().take() {
        let _ = std::fs::remove_file(path);
    }
}

/// Begins a file in a folder.
pub(super) fn begin_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut beside = lock_beside();
    let file = studio::begin_file(folder)?;
    *beside = Some(file.path().to_path_buf());
    Ok(file)
}

/// Gives the file its final name. An incomplete file does not replace an older complete one: it gets another name next to it,
/// which is returned.
pub(super) fn rename_file(
    file: NamedTempFile,
    path: &Path,
    older: bool,
) -> io::Result<Option<PathBuf>> {
    let other = (older && CUT.load(Ordering::SeqCst)).then(|| interrupted_name(path));
    file.persist(other.as_deref().unwrap_or(path))?;
    *lock_beside() = None;
    Ok(other)
}

/// Returns `page.interrupted.html` for `page.html`.
fn interrupted_name(path: &Path) -> PathBuf {
    let mut ending = OsString::from("interrupted");
    if let Some(own) = path.extension() {
        ending.push(".");
        ending.push(own);
    }
    path.with_extension(ending)
}
