//! What a catalogue holds once something was added to it.

use crate::catalog::store::Store;
use crate::cli::done::Done;
use crate::cli::terminal::output;
use crate::view::catalog::structures::built_text;
use std::path::Path;

/// Says what a catalogue holds now that so many of something were added, and that it was interrupted where it was.
pub(super) fn built(
    store: &Store,
    path: &Path,
    added: usize,
    what: &str,
    interrupted: Option<String>,
) -> anyhow::Result<Done> {
    output::to(None, |out| {
        let text = built_text(store, path, added, what, output::width(None))?;
        write!(out, "{text}")?;
        if let Some(why) = interrupted {
            writeln!(out, "\nInterrupted: {why}")?;
        }
        Ok(Done::Found)
    })
}
