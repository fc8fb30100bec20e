//! `ozols draw`.

use super::args::{Args, File};
use super::request::Which;
use super::{Done, load, output, variant};
use crate::draw::{self, Drawing, Size, Subject};
use crate::model::mechanism::StateId;
use crate::redundancy::analysis::{Method, analyse};
use anyhow::{bail, ensure};
use clap::{Args as ClapArgs, ValueEnum};
use std::io::IsTerminal;
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DrawKind {
    /// Links as polygons, joints as circles with their class, contours tinted by their redundant constraints.
    Scheme,
    /// Links and the symbols of joints in place, from the coordinates.
    Kinematic,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Draw {
    #[command(flatten)]
    file: File,
    /// What is drawn.
    #[arg(long, value_enum, default_value = "scheme")]
    kind: DrawKind,
    /// A state named in the file.
    #[arg(long, default_value = "free")]
    state: String,
    /// Draw variant K of the list that `ozols search FILE` gives, with the same of the options below, its changes marked.
    #[arg(long, value_name = "K", group = "chosen")]
    variant: Option<usize>,
    /// The first variant of idea K, as short texts of `ozols search FILE` number them: --distinct --variant K.
    #[arg(long, value_name = "K", group = "chosen")]
    idea: Option<usize>,
    /// PNG instead of SVG (where built with the feature `png`); a file named .png is one anyway.
    #[arg(long)]
    png: bool,
    /// Pixels of a PNG for each of the drawing's; 2 by default.
    #[arg(long, value_name = "X")]
    scale: Option<f64>,
    /// Width of a PNG in pixels.
    #[arg(long, value_name = "PIXELS", conflicts_with = "scale")]
    width: Option<u32>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten, next_help_heading = "The list that --variant is of")]
    which: Which,
}

pub(super) fn run(_: &Args, a: &Draw) -> anyhow::Result<Done> {
    let wanted = picture(a)?;
    let mut mechanism = load::mechanism(&a.file.file)?;
    let Some(state) = mechanism.state(&a.state) else {
        bail!(
            "{} has no state {}; it has: {}",
            mechanism.name,
            a.state,
            mechanism.states.join(", ")
        );
    };
    let mut marks = None;
    let searched = state != StateId::FREE;
    let mut request = a.which.request(searched.then_some(a.state.as_str()))?;
    let mut tolerance = None;
    request.distinct |= a.idea.is_some();
    if let Some(k) = a.variant.or(a.idea) {
        let (realized, changes) = variant::kth(mechanism, request, k, |v| {
            let search = &v.outcome().search;
            draw::marks::of_variant(search, v.assignment(), &format!("variant {k}"))
        })?;
        (mechanism, marks) = (realized, Some(changes));
    } else {
        tolerance = request.tolerance()?;
    }
    let found = analyse(&mechanism, &[state], Method::Auto { tolerance })?;
    let subject = Subject {
        mechanism: &mechanism,
        state,
        analysis: found.first(),
        marks,
    };
    let drawing = match a.kind {
        DrawKind::Scheme => draw::scheme(&subject),
        DrawKind::Kinematic => draw::kinematic(&subject),
    };
    let bytes = match wanted {
        Some(size) => png(&drawing, size)?,
        None => drawing.svg.into_bytes(),
    };
    output::to(a.output.as_deref(), |out| {
        out.write_all(&bytes)?;
        Ok(Done::Found)
    })
}

/// What PNG is wanted, if it is; said before any work is done.
fn picture(a: &Draw) -> anyhow::Result<Option<Size>> {
    let named = a.output.as_ref().and_then(|p| p.extension());
    if !a.png && !named.is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        ensure!(
            a.scale.is_none() && a.width.is_none(),
            "--scale and --width are for PNG: add --png, or -o with a name that ends in .png; SVG is of any size"
        );
        return Ok(None);
    }
    ensure!(
        cfg!(feature = "png"),
        "this ozols was built without PNG: build it with `cargo build --release --features png`, or write SVG and turn \
         it into PNG by another program"
    );
    ensure!(
        a.output.is_some() || !std::io::stdout().is_terminal(),
        "a PNG is no text for a terminal: give a file with -o"
    );
    let scale = a.scale.unwrap_or(2.0);
    ensure!(
        scale > 0.0 && scale <= 100.0,
        "--scale must be above 0 and at most 100"
    );
    ensure!(a.width != Some(0), "--width must be at least 1");
    Ok(Some(a.width.map_or(Size::Scale(scale), Size::Width)))
}

#[cfg(feature = "png")]
fn png(drawing: &Drawing, size: Size) -> anyhow::Result<Vec<u8>> {
    let picture = draw::png::png(drawing, size)?;
    if !picture.missing.is_empty() {
        let missing: String = picture.missing.iter().collect();
        output::note(&format!(
            "warning: no font of this machine has {missing}; they are missing in the PNG\n"
        ));
    }
    Ok(picture.png)
}

#[cfg(not(feature = "png"))]
fn png(_: &Drawing, size: Size) -> anyhow::Result<Vec<u8>> {
    // `picture` has refused it
    bail!("built without PNG: {size:?}")
}
