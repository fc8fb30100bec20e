//! Arguments of several commands, and arguments of every command.

use crate::cli::terminal::{Done, output};
use crate::draw::Drawing;
use anyhow::ensure;
use clap::{Args as ClapArgs, ValueEnum};
use std::path::{Path, PathBuf};

pub(crate) mod load;
pub(crate) mod named;
pub(crate) mod reading;
pub(crate) mod request;
pub(crate) mod variant;

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

/// Parses three numbers with commas between them.
pub(crate) fn parse_three(text: &str) -> Option<[f64; 3]> {
    let parts: Option<Vec<f64>> = text.split(',').map(|p| p.trim().parse().ok()).collect();
    parts?.try_into().ok()
}

/// Returns true if the name of a file ends in .png.
pub(crate) fn named(path: Option<&Path>) -> bool {
    let end = path.and_then(Path::extension);
    end.is_some_and(|e| e.eq_ignore_ascii_case("png"))
}

/// Refuses PNG where this build makes none.
pub(crate) fn ensure_png() -> anyhow::Result<()> {
    ensure!(
        cfg!(feature = "png"),
        "this ozols was built without PNG; build it with `cargo build --release --features png`, \
        or write SVG and convert it with another program"
    );
    Ok(())
}

/// Renders a drawing as PNG; reports characters that no font has.
#[cfg(feature = "png")]
pub(crate) fn render_png(drawing: &Drawing, width: Option<u32>) -> anyhow::Result<Vec<u8>> {
    let picture = crate::draw::png::png(drawing, width)?;
    if !picture.missing.is_empty() {
        let missing: String = picture.missing.iter().collect();
        crate::cli::terminal::output::print_note(&format!(
            "warning: no font on this machine has {missing}; the PNG omits them\n"
        ));
    }
    Ok(picture.png)
}

/// Returns an error, because this build has no PNG.
#[cfg(not(feature = "png"))]
pub(crate) fn render_png(_: &Drawing, _: Option<u32>) -> anyhow::Result<Vec<u8>> {
    ensure_png().map(|()| Vec::new())
}
