//! Data to standard output or, whole or not at all, to a file; complaints to standard error.

use super::working;
use crate::api;
use crate::file::problem::ImportError;
use anyhow::Context;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The temporary file that is being written, to be removed where the program ends in between.
static BESIDE: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Removes the temporary file that is being written, if one is.
pub(super) fn abandon() {
    if let Some(path) = beside().take() {
        let _ = std::fs::remove_file(path);
    }
}

fn beside() -> MutexGuard<'static, Option<PathBuf>> {
    BESIDE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Standard output, on which nothing is drawn over what is written.
struct Standard(std::io::StdoutLock<'static>);

impl Write for Standard {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        working::rest();
        self.0.write(bytes)
    }
    fn flush(&mut self) -> std::io::Result<()> {
        self.0.flush()
    }
}

/// The file to write to, if it is not standard output.
fn file(path: Option<&Path>) -> Option<&Path> {
    path.filter(|p| *p != Path::new("-"))
}

/// Runs `write` on standard output, which is also `-`, or on a file that appears under its name only once it is complete.
pub(super) fn to(
    path: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<super::Done>,
) -> anyhow::Result<super::Done> {
    let Some(path) = file(path) else {
        let mut out = BufWriter::new(Standard(std::io::stdout().lock()));
        let done = write(&mut out)?;
        out.flush()?;
        return Ok(done);
    };
    let whole = || format!("cannot write {}", path.display());
    // A link is followed, so that its target gets the data; a device or pipe has no beside and is written to directly.
    let path = &std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let old = path.metadata().ok();
    if old.as_ref().is_some_and(|m| !m.is_file() && !m.is_dir()) {
        let file = std::fs::OpenOptions::new()
            .write(true)
            .open(path)
            .with_context(whole)?;
        let mut out = BufWriter::new(file);
        let done = write(&mut out)?;
        out.flush().with_context(whole)?;
        return Ok(done);
    }
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    if path.is_dir() {
        anyhow::bail!("{}: it is a folder; name a file in it", whole());
    }
    if !folder.is_dir() {
        anyhow::bail!(
            "{}: there is no folder {}; make it first",
            whole(),
            folder.display()
        );
    }
    let mut temporary = {
        let mut beside = beside();
        let temporary = ordinary().tempfile_in(folder).with_context(whole)?;
        *beside = Some(temporary.path().to_path_buf());
        temporary
    };
    let done = {
        let mut out = BufWriter::new(temporary.as_file_mut());
        let done = write(&mut out)?;
        out.flush().with_context(whole)?;
        done
    };
    if let Some(old) = old {
        let file = temporary.as_file();
        file.set_permissions(old.permissions())
            .with_context(whole)?;
    }
    temporary.persist(path).with_context(whole)?;
    *beside() = None;
    Ok(done)
}

/// Writes files, by name and content, to a folder.
pub(super) fn files(
    folder: &Path,
    files: impl IntoIterator<Item = (String, String)>,
) -> anyhow::Result<()> {
    for (name, text) in files {
        to(Some(&folder.join(&name)), |out| {
            out.write_all(text.as_bytes())?;
            Ok(super::Done::Found)
        })?;
    }
    Ok(())
}

/// Makes temporary files that may be read by whom the umask lets: they become results.
fn ordinary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

/// A value as JSON for people to read and programs to parse.
pub(super) fn json(out: &mut dyn Write, value: &impl serde::Serialize) -> anyhow::Result<()> {
    Ok(writeln!(out, "{}", serde_json::to_string_pretty(value)?)?)
}

/// No text is fitted to less.
const NARROWEST: u16 = 40;

/// Width that standard output is fitted to: what `OZOLS_WIDTH` says, else that of its terminal.
pub(super) fn width(path: Option<&Path>) -> Option<u16> {
    match file(path) {
        None => fitted(&console::Term::stdout()),
        Some(_) => None,
    }
}

/// The same of standard error.
pub(super) fn error_width() -> Option<u16> {
    fitted(&console::Term::stderr())
}

fn fitted(to: &console::Term) -> Option<u16> {
    // Not COLUMNS: whoever uses readline, as Python's shell does, hands it to programs whose output is kept.
    let said = std::env::var("OZOLS_WIDTH")
        .ok()
        .and_then(|c| c.parse().ok());
    let found = said.or_else(|| to.is_term().then(|| to.size().1));
    found.map(|w: u16| w.max(NARROWEST))
}

/// Whether the reader of our output has gone away.
pub(super) fn is_broken_pipe(e: &anyhow::Error) -> bool {
    e.chain().any(|c| {
        c.downcast_ref::<std::io::Error>()
            .is_some_and(|io| io.kind() == std::io::ErrorKind::BrokenPipe)
    })
}

/// Whether nothing but errors is said on standard error.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Leaves out all notes from now on.
pub(super) fn hush() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Says something on standard error; a closed one is no failure.
pub(super) fn note(text: &str) {
    if QUIET.load(Ordering::Relaxed) {
        return;
    }
    working::rest();
    let _ = write!(std::io::stderr().lock(), "{text}");
}

/// Says what went wrong, in colour where standard error is a terminal that wants it (NO_COLOR, CLICOLOR_FORCE), as the
/// parser of the arguments does.
pub(super) fn complain(e: &anyhow::Error) {
    // What went wrong with a file may be why a search went wrong.
    let file = e
        .chain()
        .find_map(|c| match c.downcast_ref::<api::Error>() {
            Some(api::Error::File(problems)) => Some(problems),
            _ => c.downcast_ref::<ImportError>(),
        });
    let text = match file {
        Some(import) => import.render(true),
        None => {
            let style = anstyle::AnsiColor::Red.on_default().bold();
            format!("{style}error:{style:#} {e:#}")
        }
    };
    coloured_note(&text);
}

/// Says something on standard error, its colours left out where they are not wanted.
pub(super) fn coloured_note(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{text}");
}
