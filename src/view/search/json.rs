//! A search as JSON, and its variants as JSON lines, written as they come.

use crate::score::outcome::Outcome;
use crate::score::variant::Variant;
use crate::score::variants::Variants;
use crate::search::answer::why_none::{Hopeless, Relaxation};
use crate::search::diagram::Stop;
use crate::view::search::data::{EndData, NoneData, SearchData, TailData};
use crate::view::search::variant::VariantData;
use crate::view::search::why::{self, WhyData};
use num_bigint::BigUint;
use num_traits::Zero;
use std::io::{self, Write};

/// Writes an outcome with its variants as one value; `eased` is told where there is none, `seconds` where somebody has a
/// clock, asked once all else is written. No other key differs between runs.
///
/// # Errors
/// Those of the writer.
pub fn write(
    out: &mut dyn Write,
    outcome: &Outcome,
    mut variants: Variants<'_>,
    (eased, hopeless): (&[(Relaxation, BigUint)], &Hopeless),
    seconds: Option<&dyn Fn() -> f64>,
) -> io::Result<()> {
    // Variants stream: the closing brace of the header waits for them.
    let text = serde_json::to_string_pretty(&SearchData::new(outcome))?;
    let open = text.strip_suffix("\n}").unwrap_or(&text);
    write!(out, "{open},\n  \"variants\": [")?;
    let mut each = |v: &Variant<'_>, why: Option<WhyData>| -> io::Result<()> {
        let comma = if v.position() == 1 { "" } else { "," };
        write!(out, "{comma}\n    ")?;
        let data = VariantData::new(outcome, v).because(why);
        Ok(serde_json::to_writer(&mut *out, &data)?)
    };
    if outcome.request.distinct {
        let ideas: Vec<Variant<'_>> = variants.by_ref().collect();
        let shown: Vec<_> = ideas.iter().map(Variant::assignment).collect();
        let whys = why::data(outcome, &shown).into_iter();
        for (v, why) in ideas.iter().zip(whys) {
            each(v, Some(why))?;
        }
    } else {
        variants.by_ref().try_for_each(|v| each(&v, None))?;
    }
    let m = &outcome.search.mechanism;
    let none = outcome.admissible.total.is_zero();
    let none = none.then(|| NoneData::new(m, eased, hopeless));
    let seconds = seconds.map(|s| s());
    let tail = TailData::new(&variants, none, seconds);
    let text = serde_json::to_string_pretty(&tail)?;
    let rest = text.strip_prefix("{\n").unwrap_or(&text);
    writeln!(out, "\n  ],\n{rest}")
}

/// Writes the variants, one a line, and a last line that says why where they are not all that was asked for.
///
/// # Errors
/// Those of the writer.
pub fn write_lines(
    out: &mut dyn Write,
    outcome: &Outcome,
    mut variants: Variants<'_>,
) -> io::Result<()> {
    for v in variants.by_ref() {
        serde_json::to_writer(&mut *out, &VariantData::new(outcome, &v))?;
        writeln!(out)?;
    }
    if variants.stop() != Stop::Exhausted || outcome.numeric.is_some() || !outcome.is_confirmed() {
        serde_json::to_writer(&mut *out, &EndData::new(outcome, &variants))?;
        writeln!(out)?;
    }
    Ok(())
}
