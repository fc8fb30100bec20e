//! Files that change, however an editor writes them: in place, or under another name that is changed to theirs.

use crate::api::MAX_DESCRIPTION_BYTES;
use crate::file::bounded;
use anyhow::Context;
use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{Event, RecommendedWatcher, RecursiveMode, Watcher};
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// So long nothing may happen before a file is taken to be written.
const QUIET: Duration = Duration::from_millis(80);

/// Files, what was in them when they were looked at, and news of their folders.
pub(super) struct Changes {
    files: Vec<(PathBuf, Option<Vec<u8>>)>,
    news: Receiver<notify::Result<Event>>,
    // It ends when it is dropped.
    _watcher: RecommendedWatcher,
}

impl Changes {
    pub(super) fn new<'p>(files: impl Iterator<Item = &'p Path>) -> anyhow::Result<Changes> {
        let (tell, news) = channel();
        let files: Vec<_> = files.map(|f| (f.to_path_buf(), None)).collect();
        let mut folders = BTreeSet::new();
        let mut names = BTreeSet::new();
        for (file, _) in &files {
            // A link may be turned to another file, and what it leads to may change.
            for path in [Some(file.clone()), std::fs::canonicalize(file).ok()] {
                let path = path.unwrap_or_default();
                names.extend(path.file_name().map(OsString::from));
                let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
                folders.insert(folder.unwrap_or(Path::new(".")).to_path_buf());
            }
        }
        // Called on a thread of its own; who no longer listens needs no telling.
        let hear = move |event: notify::Result<Event>| {
            if event.as_ref().map_or(true, |e| concerns(e, &names)) {
                let _ = tell.send(event);
            }
        };
        let mut watcher = notify::recommended_watcher(hear).context("cannot watch files")?;
        for folder in folders {
            watcher
                .watch(&folder, RecursiveMode::NonRecursive)
                .with_context(|| format!("cannot watch the folder {}", folder.display()))?;
        }
        Ok(Changes {
            files,
            news,
            _watcher: watcher,
        })
    }

    /// Takes what is in the files now for seen.
    pub(super) fn take(&mut self) {
        for (file, seen) in &mut self.files {
            *seen = bounded::bytes(file, MAX_DESCRIPTION_BYTES).ok();
        }
    }

    /// Waits until something else is in a file than was taken for seen, and nobody has written to any for a moment. A file
    /// that is gone is waited for.
    pub(super) fn wait(&mut self) -> anyhow::Result<()> {
        loop {
            self.news.recv().context("files are watched no longer")??;
            loop {
                match self.news.recv_timeout(QUIET) {
                    Ok(event) => drop(event?),
                    Err(RecvTimeoutError::Timeout) => break,
                    Err(e) => return Err(e).context("files are watched no longer"),
                }
            }
            let differs = |(file, seen): &(PathBuf, Option<Vec<u8>>)| {
                let now = bounded::bytes(file, MAX_DESCRIPTION_BYTES).ok();
                now.is_some() && now != *seen
            };
            if self.files.iter().any(differs) {
                return Ok(());
            }
        }
    }
}

/// Whether something may have been written to a file of one of the names: reading is no change.
fn concerns(event: &Event, names: &BTreeSet<OsString>) -> bool {
    let written = match event.kind {
        EventKind::Access(AccessKind::Close(AccessMode::Write)) => true,
        EventKind::Access(_) => false,
        _ => true,
    };
    let named = |p: &PathBuf| p.file_name().is_some_and(|n| names.contains(n));
    written && (event.need_rescan() || event.paths.iter().any(named))
}
