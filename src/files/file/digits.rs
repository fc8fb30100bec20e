//! Decimals that end with zeros, which the readers of TOML and JSON drop.
//!
//! As a double 0.49400 is 0.494, which seems to be known less precisely.

use crate::file::locate::{Document, DocumentPath};
use serde_json::Value;
use std::ops::Range;

/// Tables and keys with coordinates.
const GEOMETRY: [&str; 6] = [
    "plane_normal",
    "parameter",
    "joint",
    "coupling",
    "point",
    "search",
];
/// The keys of those tables whose numbers are coordinates.
const COORDINATES: [&str; 6] = ["point", "axis", "reference", "lead", "pitch", "ratio"];

/// Returns the text of a document with values `all` in which the coordinates that end with a zero are in quotes: expressions of the
/// same value. Returns `None` if there are none.
pub(crate) fn quote_decimals(text: &str, json: bool, all: &Value) -> Option<String> {
    let digits = |c: char| c.is_ascii_digit() || c == '_' || c == '.';
    let mut words = text.split(|c| !digits(c));
    if !words.any(|w| w.contains('.') && w.ends_with('0')) {
        return None;
    }
    let document = Document::new(text, json)?;
    let mut found: Vec<(Range<usize>, String)> = Vec::new();
    let tables = all.as_object()?.iter();
    for (key, value) in tables.filter(|(k, _)| GEOMETRY.contains(&k.as_str())) {
        let whole = ["plane_normal", "parameter"].contains(&key.as_str());
        visit_decimals(
            value,
            &DocumentPath::root_key(key),
            whole,
            &mut |path, x| {
                let span = document.find_span(path)?;
                let written = text.get(span.clone())?.trim().replace('_', "");
                let mantissa = written.split(['e', 'E']).next().unwrap_or("");
                // A missing path has the span of what is around it, which is not this number.
                if mantissa.contains('.') && mantissa.ends_with('0') && written.parse() == Ok(x) {
                    found.push((span, written));
                }
                Some(())
            },
        );
    }
    found.sort_by_key(|(span, _)| span.start);
    let mut out = text.to_owned();
    for (span, written) in found.iter().rev() {
        out.replace_range(span.clone(), &format!("\"{written}\""));
    }
    (!found.is_empty()).then_some(out)
}

/// Visits the decimals below a value that are coordinates; all of them are if it is `whole`.
fn visit_decimals(
    value: &Value,
    at: &DocumentPath,
    whole: bool,
    visit: &mut dyn FnMut(&DocumentPath, f64) -> Option<()>,
) {
    match value {
        Value::Number(n) if n.is_f64() && whole => {
            n.as_f64().and_then(|x| visit(at, x));
        }
        Value::Array(list) => {
            for (i, item) in list.iter().enumerate() {
                visit_decimals(item, &at.entry_at(i), whole, visit);
            }
        }
        Value::Object(table) => {
            for (key, item) in table {
                let whole = whole || COORDINATES.contains(&key.as_str());
                visit_decimals(item, &at.key(key), whole, visit);
            }
        }
        _ => {}
    }
}
