//! Arguments of several commands, and arguments of every command.

pub(crate) mod load;
pub(crate) mod named;
pub(crate) mod picture;
pub(crate) mod reading;
pub(crate) mod request;
pub(crate) mod variant;

use crate::cli::terminal::{Done, output};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::{Path, PathBuf};

#[derive(Debug, ClapArgs)]
pub(crate) struct Global {
    /// Print errors only: no progress, import report or warnings.
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Number of threads [default: all processors]. Results do not depend on it.
    #[arg(long, global = true, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Seed of random samples.
    #[arg(long, global = true, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
}

/// The file that a command writes.
#[derive(Debug, ClapArgs)]
pub(crate) struct ToFile {
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl ToFile {
    pub(crate) fn path(&self) -> Option<&Path> {
        self.output.as_deref()
    }

    /// Returns the width that a text may have there, or `None` for any.
    pub(crate) fn width(&self) -> Option<u16> {
        output::output_width(self.path())
    }

    /// Writes a text or other bytes.
    pub(crate) fn write_all_of(&self, all: impl AsRef<[u8]>) -> anyhow::Result<Done> {
        output::write_bytes(self.path(), all)
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TextOrJson {
    Text,
    Json,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TextJsonOrCsv {
    Text,
    Json,
    Csv,
}
