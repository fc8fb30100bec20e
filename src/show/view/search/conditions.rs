//! What is asked of variants in a state besides the free one, in words.

use crate::format::list;
use crate::model::mechanism::{JointId, Mechanism};
use crate::search::Search;
use crate::search::answer::why_none::Hopeless;
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

/// Why nothing can be found, whatever is chosen; nothing where that may be.
#[must_use]
pub(crate) fn hopeless(m: &Mechanism, why: &Hopeless) -> String {
    let named = |joints: &[JointId]| {
        let ids = joints.iter().map(|&j| m.joints[j].id.as_str());
        list(&ids.collect_vec())
    };
    let mut out = String::new();
    if let Some(least) = why.least_redundant {
        out += &format!(
            "  Every joint at the freest of its options leaves σ = {least}: no choice of them can do\n"
        );
        let (driven, others): (Vec<_>, Vec<_>) =
            why.unchanged.iter().partition(|&&j| m.joints[j].drive);
        for (joints, reason) in [(driven, "driven"), (others, "not offered any option")] {
            if !joints.is_empty() {
                let (stays, it) = match joints.len() {
                    1 => ("stays as it is for it is", "it"),
                    _ => ("stay as they are for they are", "them"),
                };
                out += &format!(
                    "  {} {stays} {reason}; `options = [...]` of its own would let the search change {it}\n",
                    named(&joints)
                );
            }
        }
    }
    if !why.frozen.is_empty() {
        out += &format!(
            "  Nothing moves the drive {} in the mechanism as it is: it is locked, and variants that keep the output motion \
             stay so\n",
            named(&why.frozen)
        );
    }
    out
}
