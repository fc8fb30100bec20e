//! What publications say of the mechanism they show: confirmed, or what is right instead.

use crate::model::claim::{Claim, Topic};
use crate::view::prelude::*;

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
pub(crate) fn claims_text(claims: &[&Claim], width: Option<u16>) -> String {
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
    format!("{}\n{table}\n", count_claims(claims))
}
