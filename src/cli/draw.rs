//! `ozols draw`.

use super::args::{Args, Draw, DrawKind};
use super::{Done, load, output, variant};
use crate::draw::{self, Drawing, Subject};
use crate::redundancy::analysis::{Method, analyse};
use anyhow::bail;

pub(super) fn run(_: &Args, a: &Draw) -> anyhow::Result<Done> {
    let mut mechanism = load::mechanism(&a.file.file)?;
    let Some(state) = mechanism.states.iter().position(|s| *s == a.state) else {
        bail!(
            "{} has no state {}; it has: {}",
            mechanism.name,
            a.state,
            mechanism.states.join(", ")
        );
    };
    let mut marks = None;
    if let Some(k) = a.variant {
        let external = a.question.max_external.is_some() && state > 0;
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
    let bytes = if a.png {
        png(&drawing)?
    } else {
        drawing.svg.into_bytes()
    };
    output::to(a.output.as_deref(), |out| {
        out.write_all(&bytes)?;
        Ok(Done::Found)
    })
}

/// Two pixels for each of the drawing's.
#[cfg(feature = "png")]
fn png(drawing: &Drawing) -> anyhow::Result<Vec<u8>> {
    Ok(draw::png::png(drawing, 2.0)?)
}

#[cfg(not(feature = "png"))]
fn png(_: &Drawing) -> anyhow::Result<Vec<u8>> {
    bail!(
        "this ozols was built without PNG; build it with `--features png`, or turn the SVG into PNG by another program"
    )
}
