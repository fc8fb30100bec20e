//! What publications say of the mechanism they show: confirmed, or what is right instead.

use crate::format::phrase::plural;
use crate::model::claim::{self, Topic};
use crate::view::terminal::layout::table;
use serde::Serialize;

/// A claim; its keys are a stable contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Claim<'a> {
    /// The publication and the place in it.
    pub source: &'a str,
    /// What is said there.
    pub claim: &'a str,
    /// Whether it is so.
    pub holds: bool,
    /// What is right instead; nothing where it holds.
    pub right: Option<&'a str>,
    /// What that rests on.
    pub evidence: &'a str,
}

impl<'a> Claim<'a> {
    fn new(c: &'a claim::Claim) -> Claim<'a> {
        Claim {
            source: &c.source,
            claim: &c.says,
            holds: c.holds(),
            right: c.right.as_deref(),
            evidence: &c.evidence,
        }
    }
}

/// Those about a topic, in the order of the file.
#[must_use]
pub(crate) fn about(claims: &[claim::Claim], topic: Topic) -> Vec<Claim<'_>> {
    let of_topic = claims.iter().filter(|c| c.topic == topic);
    of_topic.map(Claim::new).collect()
}

/// A table of them under a line that counts them; empty where there are none.
#[must_use]
pub(crate) fn text(claims: &[Claim<'_>], width: Option<u16>) -> String {
    if claims.is_empty() {
        return String::new();
    }
    let wrong = claims.iter().filter(|c| !c.holds).count();
    let rows = claims.iter().map(|c| {
        let why = match c.right {
            Some(right) => format!("right: {right}; {}", c.evidence),
            None => c.evidence.to_owned(),
        };
        let so = if c.holds { "yes" } else { "NO" };
        vec![c.source.to_owned(), c.claim.to_owned(), so.to_owned(), why]
    });
    format!(
        "\n  What is published of this mechanism: {}, {} confirmed, {wrong} refuted\n\n{}\n",
        plural(claims.len(), "claim"),
        claims.len() - wrong,
        table(&["where", "claim", "so", "evidence"], rows.collect(), width)
    )
}
