//! A drawing as PNG. DejaVu Sans is built in, so that the picture is the same on every machine. System fonts serve only
//! for characters that it lacks.

use crate::draw::sheet::Drawing;
use resvg::usvg::fontdb::Database;
use resvg::{tiny_skia, usvg};
use skrifa::{FontRef, MetadataProvider};
use std::collections::BTreeSet;
use thiserror::Error;

/// Most pixels of a picture, at four bytes each.
const MOST: f64 = 1e8;

/// Why there is no picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PngError {
    /// The drawing could not be read back.
    #[error("cannot read the drawing back: {0}")]
    Svg(#[from] usvg::Error),
    /// The picture is too large to be held.
    #[error("a picture of {width:.0} x {height:.0} pixels is too large; ask for a smaller one")]
    TooLarge {
        /// Its width.
        width: f64,
        /// Its height.
        height: f64,
    },
    /// The picture could not be written.
    #[error("cannot write PNG: {0}")]
    Encode(String),
}

/// A picture.
#[derive(Debug)]
pub struct Picture {
    /// The file.
    pub png: Vec<u8>,
    /// Characters that no font of this machine has.
    pub missing: BTreeSet<char>,
}

/// Pixels for each of the drawing's, by default.
const ZOOM: f64 = 2.0;

/// Returns the drawing as PNG on white, with a width in pixels, or with twice that of the drawing.
///
/// # Errors
/// Returns an error if the picture would be too large for memory.
pub fn png(drawing: &Drawing, width: Option<u32>) -> Result<Picture, PngError> {
    let zoom = width.map_or(ZOOM, |width| f64::from(width) / drawing.width);
    let (width, height) = (zoom * drawing.width, zoom * drawing.height);
    let too_large = || PngError::TooLarge { width, height };
    let pixels = |x: f64| x.round().max(1.0);
    let fits = zoom.is_finite() && pixels(width) * pixels(height) <= MOST;
    if !fits {
        return Err(too_large());
    }
    let mut options = usvg::Options::default();
    let missing = fonts(drawing, options.fontdb_mut());
    let tree = usvg::Tree::from_str(&drawing.svg, &options)?;
    let mut canvas = tiny_skia::Pixmap::new(pixels(width) as u32, pixels(height) as u32)
        .ok_or_else(too_large)?;
    canvas.fill(tiny_skia::Color::WHITE);
    let scale = tiny_skia::Transform::from_scale(zoom as f32, zoom as f32);
    resvg::render(&tree, scale, &mut canvas.as_mut());
    let png = canvas
        .encode_png()
        .map_err(|e| PngError::Encode(e.to_string()))?;
    Ok(Picture { png, missing })
}

/// Adds the fonts that the drawing's texts need. Returns the characters that no font has.
fn fonts(drawing: &Drawing, fonts: &mut Database) -> BTreeSet<char> {
    fonts.load_font_data(dejavu::sans_condensed::regular().to_vec());
    fonts.load_font_data(dejavu::sans_condensed::bold().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let texts = drawing.labels.iter().flat_map(|l| l.text.chars());
    let mut missing: BTreeSet<char> = texts.filter(|c| !c.is_whitespace()).collect();
    remove_known(&mut missing, fonts);
    if !missing.is_empty() {
        fonts.load_system_fonts();
        remove_known(&mut missing, fonts);
    }
    missing
}

fn remove_known(missing: &mut BTreeSet<char>, fonts: &Database) {
    for face in fonts.faces() {
        if missing.is_empty() {
            return;
        }
        fonts.with_face_data(face.id, |data, index| {
            if let Ok(font) = FontRef::from_index(data, index) {
                let map = font.charmap();
                missing.retain(|&c| map.map(c).is_none());
            }
        });
    }
}
