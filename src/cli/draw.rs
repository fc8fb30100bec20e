//! `ozols draw`.

use super::args::{Args, Draw, DrawKind};
use super::{Done, load, output, variant};
use crate::draw::{self, Drawing, Size, Subject};
use crate::model::mechanism::StateId;
use crate::redundancy::analysis::{Method, analyse};
use anyhow::{bail, ensure};
use std::io::IsTerminal;

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
    if let Some(k) = a.variant {
        let external = a.question.max_external.is_some() && state != StateId::FREE;
        let named = external.then_some(a.state.as_str());
        let (realized, changes) =
            variant::kth(&mut mechanism, &a.question, named, k, |search, v| {
                draw::marks::of_variant(search, v, &format!("variant {k}"))
            })?;
        (mechanism, marks) = (realized, Some(changes));
    }
    let found = analyse(&mechanism, &[state], Method::Auto { tolerance: None })?;
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
        eprintln!("warning: no font of this machine has {missing}; they are missing in the PNG");
    }
    Ok(picture.png)
}

#[cfg(not(feature = "png"))]
fn png(_: &Drawing, size: Size) -> anyhow::Result<Vec<u8>> {
    // `picture` has refused it
    bail!("built without PNG: {size:?}")
}
