//! FILE arguments as typed: paths of any bytes, which are printed as text.

use crate::api::{self, MAX_DESCRIPTION_BYTES};
use crate::cli::terminal::output;
use crate::robots::Options;
use crate::view::terminal::next_commands::{self, NextCommand, shell_word};
use clap::{Args as ClapArgs, ValueHint};
use std::ffi::OsString;
use std::fmt;
use std::ops::Deref;
use std::path::{Path, PathBuf};

/// A path, `-`, or the name of a built-in mechanism. As text, invalid characters are replaced.
#[derive(Debug, Clone)]
pub(crate) struct Named {
    typed: OsString,
    text: String,
}

impl Named {
    /// Returns the argument as a path.
    pub(crate) fn path(&self) -> &Path {
        Path::new(&self.typed)
    }
}

impl From<OsString> for Named {
    fn from(typed: OsString) -> Named {
        let text = typed.to_string_lossy().into_owned();
        Named { typed, text }
    }
}

impl Deref for Named {
    type Target = str;

    fn deref(&self) -> &str {
        &self.text
    }
}

impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[derive(Debug, ClapArgs)]
pub(crate) struct File {
    /// Path, `-`, or name of a built-in mechanism.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) file: Named,
    #[command(flatten)]
    pub(crate) loops: Loops,
}

impl File {
    /// Returns the file and its loops as they are typed.
    pub(crate) fn as_typed(&self) -> String {
        let side = self.loops.path.iter();
        let side = side.map(|p| format!(" --loops {}", shell_word(&p.display().to_string())));
        shell_word(&self.file) + &side.collect::<String>()
    }

    /// Returns the next commands about the file. A caller within this process has no use for them.
    pub(crate) fn next_steps(&self, next: &[NextCommand], width: Option<u16>) -> String {
        if output::is_caught() {
            return String::new();
        }
        self.with_loops(next_commands::steps_text(next, width))
    }

    /// Returns a text whose commands about the file read its loops, too.
    pub(crate) fn with_loops(&self, text: String) -> String {
        let (file, typed) = (shell_word(&self.file), self.as_typed());
        let line = |l: &str| {
            if l.trim_start().starts_with("ozols ") {
                l.replacen(&file, &typed, 1)
            } else {
                l.to_owned()
            }
        };
        text.split_inclusive('\n').map(line).collect()
    }
}

/// The file of loop closures of a robot description: the same option for every command that takes a FILE.
#[derive(Debug, Clone, Default, ClapArgs)]
pub(crate) struct Loops {
    /// File of loop closures for a robot description (YAML, JSON or TOML): [[loop]] with a, b and type; robot.yaml of
    /// example-parallel-robots; Drake's list of ball constraints.
    #[arg(long = "loops", value_name = "SIDE", value_hint = ValueHint::FilePath)]
    pub(crate) path: Option<PathBuf>,
}

impl Loops {
    /// Returns the options of an import that reads the file.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read.
    pub(crate) fn import_options(&self) -> anyhow::Result<Options> {
        let mut options = Options::default();
        if let Some(path) = &self.path {
            output::kept::keep_file(path);
            let bytes = api::bytes(path, MAX_DESCRIPTION_BYTES)?;
            options.loops = Some((path.display().to_string(), bytes));
        }
        Ok(options)
    }
}
