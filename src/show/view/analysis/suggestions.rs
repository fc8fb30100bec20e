//! Single changes in words and as data, and what to do after an analysis.

use crate::geom::exact::ExactError;
use crate::rank::method::Certainty;
use crate::redundancy::analysis::StateAnalysis;
use crate::search::answer::single_changes::{self, Suggestion, single_changes};
use crate::view::prelude::*;

/// Maximum number of rows of a table.
const ROWS: usize = 5;
/// Maximum number of joints in a row.
const JOINTS: usize = 12;
/// Maximum number of entries of a JSON list.
const ENTRIES: usize = 50;

/// Suggestions for a state.
#[derive(Debug, Clone)]
pub enum Advice {
    /// There is nothing to remove, or nothing the state adds.
    Nothing,
    /// These changes.
    Changes(single_changes::Suggestions),
    /// None, for this reason.
    Silent(&'static str),
}

/// Returns the number of redundant constraints that suggestions are about: those of the state, or those it adds.
pub fn concerned_count(s: &StateAnalysis) -> usize {
    match &s.external {
        None => s.redundant,
        Some(e) => usize::try_from(e.by_rank).unwrap_or(0),
    }
}

/// Returns the effects of single changes in each state, on the geometry of the analysis.
///
/// # Errors
/// Returns an error if a geometry has no exact image.
pub fn advise_states(
    mechanism: &Mechanism,
    states: &[StateId],
    found: &[StateAnalysis],
) -> Result<Vec<Advice>, ExactError> {
    let one = |(&state, s): (&StateId, &StateAnalysis)| {
        if concerned_count(s) == 0 {
            return Ok(Advice::Nothing);
        }
        if matches!(s.certainty, Certainty::Undecided { .. }) {
            return Ok(Advice::Silent(
                "which constraints are redundant is not decided",
            ));
        }
        let found = single_changes(s.meant.as_deref().unwrap_or(mechanism), state)?;
        Ok(if found.redundant == s.redundant {
            Advice::Changes(found)
        } else {
            Advice::Silent(
                "the redundant constraints are there within the tolerance only, not as the coordinates are written",
            )
        })
    };
    states.iter().zip(found).map(one).collect()
}

/// Returns the advice on a state of a mechanism as data.
pub(super) fn advice_json(m: &Mechanism, s: &StateAnalysis, advice: &Advice) -> Value {
    let found = match advice {
        Advice::Nothing => return Value::Null,
        Advice::Silent(reason) => return json!({ "reason": reason, "changes": [] }),
        Advice::Changes(found) => found,
    };
    let (of, kind) = (concerned_count(s), kind_suffix(s));
    let change = |x: &Suggestion| {
        let (joint, removes, words) = (&m.joints[x.joint].id, x.removes, describe_change(m, x));
        json!({
            "joint": joint,
            "from": present_type(m, x),
            "to": x.to.as_ref().map(|o| &o.name),
            // The joint put in series with it, where one is.
            "unloading": x.unloading.as_ref().map(|o| &o.name),
            "removes": removes,
            "remaining": of.saturating_sub(removes),
            "cost": format_cost(x.cost_milli).parse().unwrap_or(0.0),
            "text": format!("{joint}: {words} removes {removes} of {of}{kind}"),
        })
    };
    json!({
        "of": of,
        // Whether these are those that the state adds.
        "external": s.external.is_some(),
        // "usual" where the file offered nothing here.
        "options": if found.usual { "usual" } else { "file" },
        "tried": found.tried,
        "found": found.list.len(),
        // Those that remove most first, then the cheaper, then in file order.
        "changes": found.list.iter().take(ENTRIES).map(change).collect::<Value>(),
    })
}

/// Returns what a joint is before a change.
fn present_type<'a>(m: &'a Mechanism, x: &Suggestion) -> &'a str {
    let joint = &m.joints[x.joint];
    let option = joint.options.first();
    option.map_or(joint.joint_type.name(), |o| &o.name)
}

/// Describes a change: "revolute -> spherical", "unloading joint in series: spherical (a ball pivot)".
fn describe_change(m: &Mechanism, x: &Suggestion) -> String {
    let to = x.to.as_ref();
    let replaced = to.map(|to| format!("{} -> {}", present_type(m, x), to.name));
    let inserted = x.unloading.as_ref().map(|u| {
        let pivot = match &*u.name {
            "spherical" => " (a ball pivot)",
            _ => "",
        };
        format!("unloading joint in series: {}{pivot}", u.name)
    });
    replaced.into_iter().chain(inserted).join(" + ")
}

fn kind_suffix(s: &StateAnalysis) -> &'static str {
    match s.external {
        Some(_) => " external",
        None => "",
    }
}

/// Returns the best single changes as a table, or that there are none.
pub(super) fn advice_text(
    m: &Mechanism,
    s: &StateAnalysis,
    advice: &Advice,
    width: Option<u16>,
) -> String {
    let found = match advice {
        Advice::Nothing => return String::new(),
        Advice::Silent(reason) => {
            return format!("\n  No single changes are suggested: {reason}\n");
        }
        Advice::Changes(found) => found,
    };
    let source = match (found.usual, found.state) {
        (false, _) => "the file's options",
        (_, StateId::FREE) => "the usual options, as the file has none",
        _ => "ball pivots in series with the contacts, as the file has no unloading joints",
    };
    let tried = found.tried;
    if found.list.is_empty() {
        return format!(
            "\n  No single change of {tried} tried ({source}) removes a redundant constraint and leaves all motions unchanged\n"
        );
    }
    // The list is sorted, and so are the groups by their firsts.
    let groups = group_by_key(found.list.iter().map(|x| {
        let change = (describe_change(m, x), x.removes, x.cost_milli);
        (change, &m.joints[x.joint].id)
    }));
    let rest = match groups.len().saturating_sub(ROWS) {
        0 => String::new(),
        n => format!(
            "\n  and {n} more; {} lists them",
            typed_option("format", "json")
        ),
    };
    let rows = groups.iter().take(ROWS);
    let rows = rows.map(|((what, removes, milli), joints)| {
        let joints = first_of(joints, JOINTS);
        let removes = format!("{removes} of {}{}", concerned_count(s), kind_suffix(s));
        row_cells([&joints, what, &removes, &format_cost(*milli)])
    });
    let one_of = if found.list.len() == 1 {
        ""
    } else {
        " (one of)"
    };
    let body = text_table(
        &format!("at{one_of} | change | removes | cost"),
        rows,
        width,
    );
    let loose = if found.state != StateId::FREE {
        "\n  (the pad of an unloading joint moves freely while no part is clamped)"
    } else {
        ""
    };
    format!(
        "\n  Single joint changes that remove redundant constraints and keep every motion\n  ({tried} tried: {source}):\n\n{body}{rest}{loose}\n"
    )
}
