//! Data to standard output or, whole or not at all, to a file; complaints to standard error.

use crate::import::problem::ImportError;
use anyhow::Context;
use std::io::{BufWriter, IsTerminal, Write};
use std::path::Path;

/// Runs `write` on standard output, or on a file that appears under its name only once it is complete.
pub(super) fn to(
    path: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<super::Done>,
) -> anyhow::Result<super::Done> {
    let Some(path) = path else {
        let mut out = BufWriter::new(std::io::stdout().lock());
        let done = write(&mut out)?;
        out.flush()?;
        return Ok(done);
    };
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let whole = || format!("cannot write {}", path.display());
    let mut beside = tempfile::NamedTempFile::new_in(folder).with_context(whole)?;
    let done = {
        let mut out = BufWriter::new(beside.as_file_mut());
        let done = write(&mut out)?;
        out.flush().with_context(whole)?;
        done
    };
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Temporary files are private; results are ordinary files.
        beside
            .as_file()
            .set_permissions(std::fs::Permissions::from_mode(0o644))
            .with_context(whole)?;
    }
    beside.persist(path).with_context(whole)?;
    Ok(done)
}

/// Width of the terminal that standard output is, if it is one.
pub(super) fn width(path: Option<&Path>) -> Option<u16> {
    (path.is_none() && std::io::stdout().is_terminal())
        .then(|| console::Term::stdout().size().1.max(60))
}

/// Whether the reader of our output has gone away.
pub(super) fn is_broken_pipe(e: &anyhow::Error) -> bool {
    e.chain().any(|c| {
        c.downcast_ref::<std::io::Error>()
            .is_some_and(|io| io.kind() == std::io::ErrorKind::BrokenPipe)
    })
}

/// Says what went wrong.
pub(super) fn complain(e: &anyhow::Error) {
    let mut err = std::io::stderr().lock();
    let colour = err.is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let _ = match e.downcast_ref::<ImportError>() {
        Some(import) => writeln!(err, "{}", import.render(colour)),
        None => writeln!(err, "error: {e:#}"),
    };
}
