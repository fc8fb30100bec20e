//! What a command reads is not written over by it.

use anyhow::ensure;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What was read, by its own path.
static READ: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
/// What a database of SQLite begins with.
const DATABASE: [u8; 16] = *b"SQLite format 3\0";

fn read() -> MutexGuard<'static, Vec<PathBuf>> {
    READ.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Lets go of what was kept: a command begins.
pub(in crate::cli) fn begin() {
    read().clear();
}

/// Keeps a file that is read.
pub(in crate::cli) fn keep(path: &Path) {
    if let Ok(path) = path.canonicalize() {
        let mut read = read();
        if !read.contains(&path) {
            read.push(path);
        }
    }
}

/// Whether a file is kept, by whatever name.
pub(in crate::cli) fn is_kept(path: &Path) -> bool {
    path.canonicalize().is_ok_and(|p| read().contains(&p))
}

/// Refuses to write over what is kept, and over a catalogue.
pub(in crate::cli) fn apart(written: &Path) -> anyhow::Result<()> {
    let same = is_kept(written);
    let name = written.display();
    ensure!(!same, "{name} is what is read; name another file to write");
    ensure!(
        !is_database(written),
        "{name} is a catalogue or another database; name another file to write"
    );
    Ok(())
}

fn is_database(path: &Path) -> bool {
    let mut head = [0; DATABASE.len()];
    // A pipe would wait for what nobody writes.
    let begins = |mut f: std::fs::File| f.read_exact(&mut head).is_ok() && head == DATABASE;
    path.is_file() && std::fs::File::open(path).is_ok_and(begins)
}
