//! A search as JSON, and its variants as JSON lines, written as they come.

use crate::score::outcome::Outcome;
use crate::score::outcome::listing::Variants;
use crate::score::outcome::remarks::Remarks;
use crate::score::outcome::variant::Variant;
use crate::score::outcome::why::Whys;
use crate::search::diagram::Stop;
use crate::view;
use crate::view::search::data;
use crate::view::search::variant::VariantData;
use crate::view::search::why::Teller;
use std::io::{self, Write};

/// Tells each variant of a list with its data until that fails; ideas with why they help.
///
/// # Errors
/// Where telling fails.
pub fn each<'a, E>(
    outcome: &Outcome,
    mut variants: impl Iterator<Item = Variant<'a>>,
    mut tell: impl FnMut(&Variant<'a>, &VariantData<'_, 'a>) -> Result<(), E>,
) -> Result<(), E> {
    let whys = outcome.request.distinct.then(|| Whys::new(outcome));
    let mut teller = whys.as_ref().map(|w| (Teller::new(outcome, w), w.teller()));
    variants.try_for_each(|v| {
        let why = teller.as_mut();
        let why = why.map(|(teller, why)| teller.data(&why(v.assignment())));
        tell(
            &v,
            &VariantData {
                outcome,
                variant: &v,
                why,
            },
        )
    })
}

/// Writes an outcome with its variants and the remarks as one value; `seconds` where somebody has a
/// clock, asked once all else is written. No other key differs between runs.
///
/// # Errors
/// Those of the writer.
pub fn write(
    out: &mut dyn Write,
    outcome: &Outcome,
    mut variants: Variants<'_>,
    remarks: &Remarks,
    seconds: Option<&dyn Fn() -> f64>,
) -> io::Result<()> {
    // Variants stream: the closing brace of the header waits for them.
    let text = view::pretty(&data::search(outcome))?;
    let open = text.strip_suffix("\n}").unwrap_or(&text);
    write!(out, "{open},\n  \"variants\": [")?;
    each(outcome, variants.by_ref(), |v, data| -> io::Result<()> {
        let comma = if v.position() == 1 { "" } else { "," };
        write!(out, "{comma}\n    ")?;
        Ok(serde_json::to_writer(&mut *out, data)?)
    })?;
    let seconds = seconds.map(|s| s());
    let tail = data::tail(outcome, &variants, remarks, seconds);
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
        let (variant, why) = (&v, None);
        let data = VariantData {
            outcome,
            variant,
            why,
        };
        serde_json::to_writer(&mut *out, &data)?;
        writeln!(out)?;
    }
    if variants.stop() != Stop::Exhausted || outcome.numeric.is_some() || !outcome.is_confirmed() {
        serde_json::to_writer(&mut *out, &data::end(outcome, &variants))?;
        writeln!(out)?;
    }
    Ok(())
}
