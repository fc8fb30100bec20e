//! `ozols draw`.

use super::args::{Args, Check, Draw, DrawKind, Question};
use super::search::{Wanted, answered};
use super::{Done, load, output};
use crate::draw::{self, Drawing, Marks, Subject};
use crate::model::mechanism::Mechanism;
use crate::redundancy::analysis::{Method, analyse};
use anyhow::{Context, bail, ensure};

pub(super) fn run(args: &Args, a: &Draw) -> anyhow::Result<Done> {
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
        let (realized, changes) = variant(args, &mechanism, k)?;
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

/// The k-th of the list that `ozols search FILE` gives.
fn variant(args: &Args, mechanism: &Mechanism, k: usize) -> anyhow::Result<(Mechanism, Marks)> {
    ensure!(k > 0, "variants are numbered from 1");
    let measured = super::question::measured(mechanism, None, false)?;
    let question = Question {
        check: Check::None,
        ..Question::default()
    };
    let wanted = Wanted {
        top: k,
        all: false,
        sample: None,
        count: false,
        by_cost: false,
    };
    let mut drawn = None;
    answered(
        args,
        mechanism,
        &question,
        measured,
        &wanted,
        |found, give| {
            let (mut last, mut seen) = (None, 0);
            give(&mut |n, v| {
                (last, seen) = (Some(v.variant), n);
                Ok(())
            })?;
            let variant = last.filter(|_| seen == k).with_context(|| {
                format!(
                    "{} has no variant {k}: the search gives {seen}",
                    mechanism.name
                )
            })?;
            let name = format!("variant {k}");
            drawn = Some(draw::marks::of_variant(found.search, &variant, &name));
            Ok(Done::Found)
        },
    )?;
    drawn.with_context(|| format!("no variant {k} of {}", mechanism.name))
}
