//! Drawings as PNG, if this build supports it.

use crate::draw::{Drawing, Size};
use anyhow::ensure;
use std::path::Path;

/// Pixels of a PNG per pixel of the drawing, by default.
pub(crate) const SCALE: f64 = 2.0;

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
pub(crate) fn render_png(drawing: &Drawing, size: Size) -> anyhow::Result<Vec<u8>> {
    let picture = crate::draw::png::png(drawing, size)?;
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
pub(crate) fn render_png(_: &Drawing, size: Size) -> anyhow::Result<Vec<u8>> {
    // `there` has refused it
    anyhow::bail!("built without PNG: {size:?}")
}
