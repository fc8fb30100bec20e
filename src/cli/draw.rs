//! `ozols draw`.

use super::args::{Args, Draw, DrawKind, Question};
use super::{Done, load, output, question, ranked};
use crate::draw::{self, Drawing, Marks, Size, Subject};
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::redundancy::analysis::{Method, analyse, exact_field};
use crate::search::request::Search;
use anyhow::{Context, bail, ensure};
use std::io::IsTerminal;
use std::ops::ControlFlow;

pub(super) fn run(_: &Args, a: &Draw) -> anyhow::Result<Done> {
    let wanted = picture(a)?;
    let mut mechanism = question::snapped(load::mechanism(&a.file.file)?, &a.question)?;
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
        let (realized, changes) = variant(&mut mechanism, state, &a.question, k)?;
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

/// The k-th of the list that `ozols search FILE` gives with the same options. Where they bear on a state, and none but
/// the free one is drawn, it is the first of the others, as in the search.
fn variant(
    mechanism: &mut Mechanism,
    state: StateId,
    q: &Question,
    k: usize,
) -> anyhow::Result<(Mechanism, Marks)> {
    ensure!(k > 0, "variants are numbered from 1");
    question::restrict(mechanism, q)?;
    let of = (state > 0 && q.max_external.is_some()).then(|| mechanism.states[state].clone());
    let taken = question::state(mechanism, q, of.as_deref())?;
    let measured = question::measured(mechanism, taken.map(|(s, _)| s), q.as_written)?;
    let tolerance = measured.map_or(DEFAULT_TOLERANCE, |(m, _)| m.tolerance());
    let request = question::request(q, taken, tolerance);
    let search = Search::new(exact_field(mechanism, 0)?, mechanism, request)?;
    let diagrams = search.build(&|| false, &mut |_| {});
    let (mut last, mut seen) = (None, 0);
    if let Some(mut ranked) = ranked::pool(&search, &diagrams, q, k)? {
        seen = ranked.list.len();
        last = ranked.list.pop().map(|r| r.variant);
    } else {
        search.cheapest(&diagrams, k, |v| {
            seen += 1;
            last = Some(v);
            ControlFlow::Continue(())
        });
    }
    let variant = last.filter(|_| seen == k).with_context(|| {
        format!(
            "{} has no variant {k}: the search gives {seen}",
            mechanism.name
        )
    })?;
    Ok(draw::marks::of_variant(
        &search,
        &variant,
        &format!("variant {k}"),
    ))
}
