//! Finished values as JSON that says which contract it keeps and as text for people, with how sure they are: figures that rest on what a
//! reader took for granted are those of the file as read.

use crate::model::claim::Claim;
use crate::view::prelude::*;

pub mod analysis;
pub mod catalog;
pub mod drive;
pub mod grip;
pub mod lint;
mod prelude;
pub mod reactions;
/// A search for people and programs: text, JSON, CSV.
pub mod search {
    pub(crate) mod counts;
    pub mod csv;
    pub mod json;
    pub mod nothing_found;
    pub(crate) mod numeric;
    pub(crate) mod ranking;
    pub(crate) mod second_opinion;
    pub mod text;
    pub mod variant;
    pub mod why;
}
pub mod statics;
pub mod stroke;
pub mod terminal;

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

/// The number of the contract of all JSON that the commands print. It is raised when a key is removed or changes its
/// meaning. New keys do not raise it.
pub const FORMAT: u32 = 1;

/// Returns a value as JSON for people and programs. An object has `format`, the number of the contract, first.
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

/// Returns the values of each key. The keys are in the order in which they first occur.
pub fn group_by_key<K: PartialEq, V>(pairs: impl IntoIterator<Item = (K, V)>) -> Vec<(K, Vec<V>)> {
    let mut out: Vec<(K, Vec<V>)> = Vec::new();
    for (key, value) in pairs {
        match out.iter_mut().find(|(known, _)| *known == key) {
            Some((_, all)) => all.push(value),
            None => out.push((key, vec![value])),
        }
    }
    out
}

/// Returns the claims about a topic, in the order of the file.
pub(crate) fn claims_about(claims: &[Claim], topic: Topic) -> Vec<&Claim> {
    claims.iter().filter(|c| c.topic == topic).collect()
}

const CONFIRMED: &str = "yes";
const REFUTED: &str = "NO";
const AS_SCANNED: &str = "NO, as scanned";

/// Returns the word for what is known of a claim.
fn claim_verdict(claim: &Claim) -> &'static str {
    match (claim.holds(), &claim.scan) {
        (true, _) => CONFIRMED,
        (false, None) => REFUTED,
        (false, Some(_)) => AS_SCANNED,
    }
}

/// Returns a line that counts the claims; empty if there are none.
pub(crate) fn count_claims(claims: &[&Claim]) -> String {
    if claims.is_empty() {
        return String::new();
    }
    let count = |so: &str| claims.iter().filter(|c| claim_verdict(c) == so).count();
    let scanned = match count(AS_SCANNED) {
        0 => String::new(),
        n => format!(", {n} refuted if the scan of the text is right"),
    };
    format!(
        "\n  Published about this mechanism: {}, {} confirmed, {} refuted{scanned}\n",
        count_noun(claims.len(), "claim"),
        count(CONFIRMED),
        count(REFUTED),
    )
}

/// Returns the same with a table of the claims.
pub(crate) fn claims_text(all: &[Claim], topic: Topic, width: Option<u16>) -> String {
    let claims = claims_about(all, topic);
    if claims.is_empty() {
        return String::new();
    }
    let rows = claims.iter().map(|c| {
        let right = c.right.iter().map(|right| format!("right: {right}; "));
        let scan = c.scan.iter();
        let scan = scan.map(|scan| format!("; the text is a scan, and this rests on {scan}"));
        let why = right.chain([c.evidence.clone()]).chain(scan).join("");
        row_cells([&c.source, &c.says, &claim_verdict(c), &why])
    });
    let table = text_table("where | claim | so | evidence", rows, width);
    fit_lines(&format!("{}\n{table}\n", count_claims(&claims)), width)
}
