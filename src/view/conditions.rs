//! What is asked of variants in a state besides the free one, in words.

use crate::search::conditions::Search;
use itertools::Itertools;

/// "hold a and have external σ ≤ 2, harmful ≤ 0, in state clamped"; of `one` variant, "holds a and has ...".
#[must_use]
pub fn in_state(search: &Search, one: bool) -> Option<String> {
    let s = search.conditions.state?;
    let m = &search.mechanism;
    let held = search.held().map(|l| m.links[l].id.as_str()).join(", ");
    let verb = |many: &'static str, single: &'static str| if one { single } else { many };
    let mut said = Vec::new();
    if !held.is_empty() {
        said.push(format!("{} {held}", verb("hold", "holds")));
    }
    let limits = [
        s.max_external.map(|n| format!("external σ ≤ {n}")),
        s.max_harmful.map(|n| format!("harmful ≤ {n}")),
    ];
    let limits = limits.into_iter().flatten().join(", ");
    match (limits.is_empty(), held.is_empty()) {
        (true, true) => said.push(format!("{} any external σ", verb("have", "has"))),
        (true, false) => {}
        (false, _) => said.push(format!("{} {limits}", verb("have", "has"))),
    }
    Some(format!(
        "{} in state {}",
        said.join(" and "),
        m.states[s.state]
    ))
}
