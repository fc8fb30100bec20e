//! The file on disk: reading, atomic writing, and the unsaved work next to it.

use crate::api::{MAX_DESCRIPTION_BYTES, folder_of};
use crate::builtin;
use crate::file::{disk, template};
use crate::robots;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::NamedTempFile;

/// A frame and nothing else.
pub(super) const BLANK: &str = include_str!("shelf/blank.toml");

/// The source of the first text.
#[derive(Debug, Clone)]
pub enum Opening {
    /// A file, which need not be there yet, and how a robot description is read.
    File(PathBuf, robots::Options),
    /// A copy of a built-in mechanism, to be saved in a folder under a name that is free.
    Builtin(String, PathBuf),
    /// A text of this name, to be saved in a folder.
    Text(String, String, PathBuf),
    /// Nothing yet.
    Nothing(PathBuf),
}

/// How a file is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Toml,
    Json,
    /// A robot description or an assembly.
    Description,
}

/// The file that is worked on.
#[derive(Debug)]
pub(super) struct OpenFile {
    pub(super) path: PathBuf,
    pub(super) kind: Kind,
    /// How it is read where it is a robot description.
    pub(super) options: robots::Options,
    /// The known content of the file, or `None` if it did not exist.
    pub(super) held: Option<Arc<[u8]>>,
    pub(super) kept: AutosavedText,
}

/// Where unsaved work is kept: a file that is locked as long as its owner lives, so that another studio tells what was left behind
/// from what is at work.
#[derive(Debug, Default)]
pub(super) struct AutosavedText {
    pub(super) path: Option<PathBuf>,
    lock: Option<File>,
}

/// Most studios that keep unsaved work of one file at a time.
const KEEPERS: usize = 20;

impl OpenFile {
    /// Reads a file in its current state.
    pub(super) fn read(path: &Path) -> io::Result<OpenFile> {
        // A link is followed, so that its target gets the data.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let mut out = OpenFile {
            kind: kind_of(&path),
            options: robots::Options::default(),
            held: None,
            kept: AutosavedText::default(),
            path,
        };
        out.held = out.bytes_now()?;
        Ok(out)
    }

    /// Returns the file name for people.
    pub(super) fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    pub(super) fn parent_folder(&self) -> &Path {
        folder_of(&self.path)
    }

    /// Returns its content, or `None` if it does not exist.
    pub(super) fn bytes_now(&self) -> io::Result<Option<Arc<[u8]>>> {
        match disk::read_bytes(&self.path, MAX_DESCRIPTION_BYTES) {
            Ok(bytes) => Ok(Some(bytes.into())),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(e),
        }
    }

    /// Writes it, whole or not at all, and takes the unsaved work away.
    pub(super) fn save_bytes(&mut self, bytes: &Arc<[u8]>) -> io::Result<()> {
        let permissions = fs::metadata(&self.path).ok().map(|m| m.permissions());
        let place = |beside: &mut File| {
            beside.write_all(bytes)?;
            permissions.map_or(Ok(()), |p| beside.set_permissions(p))?;
            beside.sync_all()
        };
        write_whole(&self.path, place)?;
        self.held = Some(bytes.clone());
        self.drop_kept();
        Ok(())
    }

    fn keeper_path(&self, n: usize) -> PathBuf {
        let number = if n == 0 {
            String::new()
        } else {
            format!("-{}", n + 1)
        };
        self.parent_folder()
            .join(format!("{}.autosave{number}", self.name()))
    }

    /// Keeps unsaved work; each time a whole file takes the place of the one before.
    pub(super) fn keep_bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        let path = match &self.kept.path {
            Some(path) => path.clone(),
            None => {
                let free = (0..KEEPERS).map(|n| self.keeper_path(n));
                let mut free = free.filter(|p| !p.exists());
                free.next().ok_or_else(|| {
                    io::Error::other("too much unsaved work is stored next to the file")
                })?
            }
        };
        let file = write_whole(&path, |beside| {
            beside.write_all(bytes)?;
            // Not every file system has locks.
            let _ = beside.try_lock();
            Ok(())
        })?;
        self.kept = AutosavedText {
            path: Some(path),
            lock: Some(file),
        };
        Ok(())
    }

    /// Removes the unsaved copy, because nothing is unsaved any more.
    pub(super) fn drop_kept(&mut self) {
        self.kept.lock = None;
        if let Some(path) = self.kept.path.take() {
            let _ = fs::remove_file(path);
        }
    }

    /// Returns unsaved work of a studio that has ended, and its path. Deletes the work if the file has the same
    /// content.
    pub(super) fn left_behind(&self) -> Option<(PathBuf, Arc<[u8]>)> {
        let all = (0..KEEPERS).map(|n| self.keeper_path(n));
        let found = all.filter(|p| p.is_file()).find_map(|path| {
            let file = File::open(&path).ok()?;
            file.try_lock().ok()?;
            let bytes = disk::read_bytes(&path, MAX_DESCRIPTION_BYTES).ok()?;
            Some((path, Arc::<[u8]>::from(bytes)))
        });
        let (path, bytes) = found?;
        if self.held.as_ref() == Some(&bytes) {
            let _ = fs::remove_file(path);
            return None;
        }
        Some((path, bytes))
    }
}

/// Writes a temporary file in the folder of a path and renames it to the path, so that no part of a file is ever there.
/// An error names the path.
fn write_whole(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<File> {
    let made = || {
        let mut beside = begin_file(folder_of(path))?;
        write(beside.as_file_mut())?;
        beside.persist(path).map_err(|e| e.error)
    };
    made().map_err(|why| {
        let words = format!("cannot write {}: {why}", path.display());
        io::Error::new(why.kind(), words)
    })
}

/// Begins a temporary file in a folder. Its permissions follow the umask, because it becomes a result.
pub(crate) fn begin_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tmp-ozols-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

fn kind_of(path: &Path) -> Kind {
    let name = path.to_string_lossy();
    let json = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("json"));
    match robots::is_description(&name) {
        true => Kind::Description,
        false if json => Kind::Json,
        false => Kind::Toml,
    }
}

/// Returns a file name that does not exist in a folder yet.
pub(super) fn free_name(folder: &Path, stem: &str) -> PathBuf {
    let names = std::iter::once(format!("{stem}.toml"))
        .chain((2..).map(|n: u32| format!("{stem}-{n}.toml")));
    let mut free = names.map(|n| folder.join(n)).filter(|p| !p.exists());
    free.next().unwrap_or_else(|| folder.join("mechanism.toml"))
}

/// Returns the name if a file may have it: a plain name with the ending .toml, in the open folder.
pub(super) fn plain_name(name: &str) -> Option<&str> {
    let stem = name.strip_suffix(".toml")?;
    let plain = |c: char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_' | '.' | '+');
    let well = (1..=100).contains(&stem.len())
        && stem.chars().all(plain)
        && !stem.starts_with(['.', ' ', '-'])
        && !stem.ends_with(['.', ' ']);
    well.then_some(name)
}

/// Returns the opened file and its first text.
pub(super) fn begin_opening(opening: &Opening) -> io::Result<(OpenFile, Option<String>)> {
    let fresh = |folder: &Path, stem: &str| OpenFile::read(&free_name(folder, stem));
    Ok(match opening {
        Opening::File(path, options) => {
            let mut file = OpenFile::read(path)?;
            file.options = options.clone();
            (file, None)
        }
        Opening::Builtin(name, folder) => (fresh(folder, name)?, Some(of_builtin(name)?)),
        Opening::Text(name, text, folder) => {
            let stem: String = name
                .chars()
                .map(|c| if c.is_alphanumeric() { c } else { '-' })
                .collect();
            (fresh(folder, stem.trim_matches('-'))?, Some(text.clone()))
        }
        Opening::Nothing(folder) => (fresh(folder, "mechanism")?, Some(BLANK.to_owned())),
    })
}

/// Returns a copy of a built-in mechanism with its own comments, without the published results on the original.
pub(super) fn of_builtin(name: &str) -> io::Result<String> {
    let text = builtin::text(name)
        .ok_or_else(|| io::Error::other(format!("{name} is not a built-in mechanism")))?;
    template::without_claims(text).map_err(io::Error::other)
}
