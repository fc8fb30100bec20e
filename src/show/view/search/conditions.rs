//! What is asked of variants in a state besides the free one, in words.

use crate::search::Search;
use itertools::Itertools;

/// "hold a in state clamped" and "have external σ ≤ 2, harmful ≤ 0 in it"; of `one` variant, "holds" and "has".
#[must_use]
pub(crate) fn in_state(search: &Search, one: bool) -> Vec<String> {
    let Some(s) = search.conditions.state else {
        return Vec::new();
    };
    let m = &search.mechanism;
    let (hold, have) = if one {
        ("holds", "has")
    } else {
        ("hold", "have")
    };
    let state = format!("in state {}", m.states[s.state]);
    let held = search.held().map(|l| m.links[l].id.as_str()).join(", ");
    let limits = [
        s.max_external.map(|n| format!("external σ ≤ {n}")),
        s.max_harmful.map(|n| format!("harmful ≤ {n}")),
    ];
    let limits = limits.into_iter().flatten().join(", ");
    match (held.is_empty(), limits.is_empty()) {
        (true, true) => vec![format!("{have} any external σ {state}")],
        (true, false) => vec![format!("{have} {limits} {state}")],
        (false, true) => vec![format!("{hold} {held} {state}")],
        (false, false) => vec![
            format!("{hold} {held} {state}"),
            format!("{have} {limits} in it"),
        ],
    }
}
