//! Drawings as PNG, where this build makes them.

use crate::draw::{Drawing, Size};
use anyhow::ensure;
use std::path::Path;

/// Pixels of a PNG for each of the drawing's, where nothing else is asked for.
pub(in crate::cli) const SCALE: f64 = 2.0;

/// Whether a file is a PNG by its name.
pub(in crate::cli) fn named(path: Option<&Path>) -> bool {
    let end = path.and_then(Path::extension);
    end.is_some_and(|e| e.eq_ignore_ascii_case("png"))
}

/// Refuses PNG where this build makes none.
pub(in crate::cli) fn there() -> anyhow::Result<()> {
    ensure!(
        cfg!(feature = "png"),
        "this ozols was built without PNG: build it with `cargo build --release --features png`, or write SVG and turn \
         it into PNG by another program"
    );
    Ok(())
}

/// A drawing as PNG; characters that no font has are told.
#[cfg(feature = "png")]
pub(in crate::cli) fn png(drawing: &Drawing, size: Size) -> anyhow::Result<Vec<u8>> {
    let picture = crate::draw::png::png(drawing, size)?;
    if !picture.missing.is_empty() {
        let missing: String = picture.missing.iter().collect();
        crate::cli::terminal::output::note(&format!(
            "warning: no font of this machine has {missing}; they are missing in the PNG\n"
        ));
    }
    Ok(picture.png)
}

/// There is none in this build.
#[cfg(not(feature = "png"))]
pub(in crate::cli) fn png(_: &Drawing, size: Size) -> anyhow::Result<Vec<u8>> {
    // `there` has refused it
    anyhow::bail!("built without PNG: {size:?}")
}
