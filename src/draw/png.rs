//! A drawing as PNG, with the fonts of the system.

use super::Drawing;
use resvg::{tiny_skia, usvg};
use thiserror::Error;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PngError {
    /// Text needs a font.
    #[error(
        "no font was found on this system, and text needs one; install one (such as fonts-dejavu), or write SVG"
    )]
    NoFont,
    /// The drawing could not be read back.
    #[error("cannot read the drawing back: {0}")]
    Svg(#[from] usvg::Error),
    /// The picture is too large to be held.
    #[error("a picture of {width} x {height} pixels is too large")]
    TooLarge {
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
    },
    /// The picture could not be written.
    #[error("cannot write PNG: {0}")]
    Encode(String),
}

/// Families for text without serifs, the best first.
const FAMILIES: [&str; 6] = [
    "DejaVu Sans",
    "Liberation Sans",
    "Noto Sans",
    "Arial",
    "Helvetica",
    "Segoe UI",
];

/// The drawing as PNG, `zoom` pixels for each of its own, on white.
///
/// # Errors
/// Where the system has no font, or the picture would be too large.
pub fn png(drawing: &Drawing, zoom: f64) -> Result<Vec<u8>, PngError> {
    let mut options = usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_system_fonts();
    let known = |family: &str| {
        fonts
            .faces()
            .any(|f| f.families.iter().any(|(name, _)| name == family))
    };
    let chosen = FAMILIES.iter().find(|f| known(f)).map(|f| (*f).to_owned());
    let any = || {
        fonts
            .faces()
            .next()
            .and_then(|f| f.families.first().map(|(n, _)| n.clone()))
    };
    let family = chosen.or_else(any).ok_or(PngError::NoFont)?;
    fonts.set_sans_serif_family(family.as_str());
    options.font_family = family;
    let tree = usvg::Tree::from_str(&drawing.svg, &options)?;
    let size = |x: f64| (x * zoom).ceil().clamp(1.0, f64::from(u32::MAX)) as u32;
    let (width, height) = (size(drawing.width), size(drawing.height));
    if f64::from(width) * f64::from(height) > 4e8 {
        return Err(PngError::TooLarge { width, height });
    }
    let mut pixels =
        tiny_skia::Pixmap::new(width, height).ok_or(PngError::TooLarge { width, height })?;
    pixels.fill(tiny_skia::Color::WHITE);
    let scale = tiny_skia::Transform::from_scale(zoom as f32, zoom as f32);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    pixels
        .encode_png()
        .map_err(|e| PngError::Encode(e.to_string()))
}
