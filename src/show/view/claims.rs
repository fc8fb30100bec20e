//! What publications say of the mechanism they show: confirmed, or what is right instead.

use crate::format::phrase::plural;
use crate::model::claim::{Claim, Topic};
use crate::view::terminal::layout::table;

/// Those about a topic, in the order of the file.
#[must_use]
pub(crate) fn about(claims: &[Claim], topic: Topic) -> Vec<&Claim> {
    claims.iter().filter(|c| c.topic == topic).collect()
}

/// A table of them under a line that counts them; empty where there are none.
#[must_use]
pub(crate) fn text(claims: &[&Claim], width: Option<u16>) -> String {
    if claims.is_empty() {
        return String::new();
    }
    let wrong = claims.iter().filter(|c| !c.holds()).count();
    let rows = claims.iter().map(|c| {
        let why = match &c.right {
            Some(right) => format!("right: {right}; {}", c.evidence),
            None => c.evidence.clone(),
        };
        let so = if c.holds() { "yes" } else { "NO" };
        vec![c.source.clone(), c.says.clone(), so.to_owned(), why]
    });
    format!(
        "\n  What is published of this mechanism: {}, {} confirmed, {wrong} refuted\n\n{}\n",
        plural(claims.len(), "claim"),
        claims.len() - wrong,
        table(&["where", "claim", "so", "evidence"], rows.collect(), width)
    )
}
