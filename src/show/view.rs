//! Finished values as JSON that says which contract it keeps and as text for people, with how sure they are: figures that rest on what a
//! reader took for granted are those of the file as read.

pub mod accuracy;
pub mod analysis;
pub mod catalog;
pub(crate) mod claims;
pub mod drive;
pub mod grip;
pub mod lint;
mod prelude;
pub mod reactions;
pub mod search;
pub mod statics;
pub mod stroke;
pub mod terminal;

use crate::format::count_noun;
use crate::model::mechanism::Mechanism;
use serde::Serialize;
use serde_json::Value;
use std::fmt::Display;

/// Returns the words for how sure a figure is, with the number of assumptions if there are any.
pub(crate) fn as_read(m: &Mechanism, sure: String) -> String {
    match with_assumptions(m) {
        None => sure,
        Some(read) => format!("{read}: {sure}"),
    }
}

/// Returns "of the file as read, with 2 assumptions". Returns `None` if nothing was assumed.
pub(crate) fn with_assumptions(m: &Mechanism) -> Option<String> {
    let n = m.assumed.len();
    (n > 0).then(|| format!("of the file as read, with {}", count_noun(n, "assumption")))
}

/// Returns the same in one word for programs: `as-read`, or the given word if nothing was assumed.
pub(crate) fn certainty_kind(m: &Mechanism, sure: &'static str) -> &'static str {
    if m.assumed.is_empty() { sure } else { AS_READ }
}

/// Word for figures that rest on assumptions.
pub(crate) const AS_READ: &str = "as-read";

/// The number of the contract of all JSON that the commands print. It is raised when a key goes or means something else; keys that
/// come are no new contract.
pub const FORMAT: u32 = 1;

/// A value as JSON for people to read and programs to parse; an object with `format`, the number of the contract, first.
///
/// # Errors
/// Returns an error if a key is not text.
///
/// # Examples
/// ```
/// #[derive(serde::Serialize)]
/// struct Rank {
///     rank: usize,
/// }
/// let text = ozols::view::pretty_json(&Rank { rank: 12 }).unwrap();
/// assert_eq!(text, "{\n  \"format\": 1,\n  \"rank\": 12\n}");
/// ```
pub fn pretty_json(value: &impl Serialize) -> serde_json::Result<String> {
    let text = serde_json::to_string_pretty(value)?;
    Ok(match text.strip_prefix("{\n") {
        Some(rest) => format!("{{\n  \"format\": {FORMAT},\n{rest}"),
        None => text,
    })
}

/// Returns "2", or "0 to 2".
pub(crate) fn format_span<T: PartialEq + Display>(least: T, most: T) -> String {
    if least == most {
        least.to_string()
    } else {
        format!("{least} to {most}")
    }
}

/// Returns one object with the entries of all.
pub(crate) fn join_objects<const N: usize>(parts: [Value; N]) -> Value {
    let entries = parts.into_iter().filter_map(|part| match part {
        Value::Object(entries) => Some(entries),
        _ => None,
    });
    entries.flatten().collect()
}
