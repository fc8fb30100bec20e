//! Temporary files next to the files they replace, so that these are either complete or unchanged.

use crate::file::disk;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;

/// Prefix of the names of such files.
const PREFIX: &str = ".tmp-ozols-";
/// Number of attempts if another process removes the file as a leftover.
const TRIES: usize = 100;

/// The file that is being written, which is removed if the program ends before it is complete, and the folders that were cleaned.
static BESIDE: Mutex<(Option<PathBuf>, BTreeSet<PathBuf>)> = Mutex::new((None, BTreeSet::new()));

fn lock_beside() -> MutexGuard<'static, (Option<PathBuf>, BTreeSet<PathBuf>)> {
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
    if let Some(path) = lock_beside().0.take() {
        let _ = std::fs::remove_file(path);
    }
}

/// Begins a file in a folder, and removes those that killed runs left there.
pub(super) fn begin_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut beside = lock_beside();
    if beside.1.insert(folder.to_owned()) {
        disk::clean_leftovers(folder, |name| {
            name.as_encoded_bytes().starts_with(PREFIX.as_bytes())
        });
    }
    let mut file = temporary_builder().tempfile_in(folder)?;
    for _ in 0..TRIES {
        // Held from here on. Whoever cleans up may have taken it before. Not every file system has locks.
        let _ = file.as_file().lock();
        if file.path().exists() {
            break;
        }
        file = temporary_builder().tempfile_in(folder)?;
    }
    beside.0 = Some(file.path().to_path_buf());
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
    lock_beside().0 = None;
    Ok(other)
}

/// Returns `page.interrupted.html` for `page.html`.
fn interrupted_name(path: &Path) -> PathBuf {
    let mut name: OsString = path.file_stem().unwrap_or_default().to_owned();
    name.push(".interrupted");
    if let Some(ending) = path.extension() {
        name.push(".");
        name.push(ending);
    }
    path.with_file_name(name)
}

/// Makes files that may be read by whom the umask lets: they become results.
fn temporary_builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}
