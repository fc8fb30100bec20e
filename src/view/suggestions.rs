//! Single changes in words and as data, and what to do after an analysis.

use crate::format::number::cost;
use crate::model::mechanism::{Mechanism, StateId};
use crate::redundancy::analysis::StateAnalysis;
use crate::search::suggest::{Suggestion, Suggestions, USUAL, USUAL_UNLOADING};
use crate::view::layout::table;
use crate::view::next::{Step, file_name};
use itertools::Itertools;
use serde_json::{Value, json};

/// Rows of a table at most.
const ROWS: usize = 5;
/// Joints named in a row at most.
const JOINTS: usize = 12;
/// Entries of a JSON list at most.
const ENTRIES: usize = 50;

/// What can be suggested for a state.
#[derive(Debug, Clone)]
pub enum Advice {
    /// There is nothing to remove, or nothing the state adds.
    Nothing,
    /// These changes.
    Changes(Suggestions),
    /// None can be told, and why.
    Silent(&'static str),
}

/// How many redundant constraints of a state suggestions are about: its own, or those it adds.
#[must_use]
pub fn concerned(s: &StateAnalysis) -> usize {
    match &s.external {
        None => s.redundant,
        Some(e) => usize::try_from(e.by_rank).unwrap_or(0),
    }
}

fn kind(s: &StateAnalysis) -> &'static str {
    if s.external.is_some() {
        " external"
    } else {
        ""
    }
}

/// A change in words: "revolute -> spherical", "an unloading joint in series: spherical (a ball pivot)".
fn change(m: &Mechanism, s: &Suggestion) -> String {
    let joint = &m.joints[s.joint];
    let present = joint
        .options
        .first()
        .map_or(joint.joint_type.name(), |o| o.name.as_str());
    let replaced = s.to.as_ref().map(|o| format!("{present} -> {}", o.name));
    let inserted = s.unloading.as_ref().map(|u| {
        let pivot = if u.name == "spherical" {
            " (a ball pivot)"
        } else {
            ""
        };
        format!("unloading joint in series: {}{pivot}", u.name)
    });
    replaced.into_iter().chain(inserted).join(" + ")
}

/// A change with what it removes and costs, and the joints at which it does.
type Row<'a> = ((String, usize, i64), Vec<&'a str>);

/// The best single changes as a table, or that there are none.
#[must_use]
pub fn text(m: &Mechanism, s: &StateAnalysis, advice: &Advice, width: Option<u16>) -> String {
    let found = match advice {
        Advice::Nothing => return String::new(),
        Advice::Silent(why) => return format!("\n  No single changes are suggested: {why}\n"),
        Advice::Changes(found) => found,
    };
    let (of, kind) = (concerned(s), kind(s));
    let source = match (found.usual, found.state) {
        (false, _) => "the file's options",
        (true, StateId::FREE) => "the usual options, as the file has none",
        (true, _) => "ball pivots in series with the contacts, as the file has no unloading joints",
    };
    if found.list.is_empty() {
        return format!(
            "\n  No single change of {} tried ({source}) removes a redundant constraint and leaves all motions as they are\n",
            found.tried
        );
    }
    // The list is sorted, and so are the groups by their firsts.
    let mut groups: Vec<Row<'_>> = Vec::new();
    for x in &found.list {
        let key = (change(m, x), x.removes, x.cost_milli);
        let joint = m.joints[x.joint].id.as_str();
        match groups.iter_mut().find(|(k, _)| *k == key) {
            Some((_, joints)) => joints.push(joint),
            None => groups.push((key, vec![joint])),
        }
    }
    let more = groups.len().saturating_sub(ROWS);
    let rows = groups.into_iter().take(ROWS);
    let rows = rows.map(|((what, removes, milli), joints)| {
        let more = match joints.len().saturating_sub(JOINTS) {
            0 => String::new(),
            n => format!(" and {n} more"),
        };
        vec![
            format!("{}{more}", joints.iter().take(JOINTS).join(", ")),
            what,
            format!("{removes} of {of}{kind}"),
            cost(milli),
        ]
    });
    let head = if found.list.len() == 1 {
        "at"
    } else {
        "at (one of)"
    };
    let body = table(&[head, "change", "removes", "cost"], rows.collect(), width);
    let rest = match more {
        0 => String::new(),
        n => format!("\n  and {n} more; --format json lists them"),
    };
    let loose = if found.state != StateId::FREE {
        "\n  (the pad of an unloading joint hangs loose while nothing is held)"
    } else {
        ""
    };
    format!(
        "\n  Single changes that remove redundant constraints and leave all motions as they are\n  (of {} tried: {source}):\n\n{body}{rest}{loose}\n",
        found.tried
    )
}

/// The same as data.
#[must_use]
pub fn data(m: &Mechanism, s: &StateAnalysis, advice: &Advice) -> Value {
    let found = match advice {
        Advice::Nothing => return Value::Null,
        Advice::Silent(why) => return json!({"reason": why, "changes": []}),
        Advice::Changes(found) => found,
    };
    let of = concerned(s);
    let one = |x: &Suggestion| {
        let joint = &m.joints[x.joint];
        let text = format!(
            "{}: {} removes {} of {of}{}",
            joint.id,
            change(m, x),
            x.removes,
            kind(s)
        );
        json!({
            "joint": joint.id,
            "from": joint.options.first().map_or(joint.joint_type.name(), |o| o.name.as_str()),
            "to": x.to.as_ref().map(|o| &o.name),
            "unloading": x.unloading.as_ref().map(|o| &o.name),
            "removes": x.removes,
            "remaining": of.saturating_sub(x.removes),
            "cost": cost(x.cost_milli).parse::<f64>().unwrap_or(0.0),
            "text": text,
        })
    };
    json!({
        "of": of,
        "external": s.external.is_some(),
        "options": if found.usual { "usual" } else { "file" },
        "tried": found.tried,
        "found": found.list.len(),
        "changes": found.list.iter().take(ENTRIES).map(one).collect::<Vec<_>>(),
    })
}

/// What to do after an analysis of `file`; `snap` is the tolerance its coordinates were snapped by, where they were.
#[must_use]
pub fn next(
    m: &Mechanism,
    states: &[StateAnalysis],
    advice: &[Advice],
    file: &str,
    snap: Option<f64>,
) -> Vec<Step> {
    let snap = snap.map_or(String::new(), |t| format!("--snap {t:e}"));
    let joined = |more: &str| format!("{more} {snap}").trim().to_owned();
    let mut steps = Vec::new();
    for (s, advice) in states.iter().zip(advice) {
        let Advice::Changes(found) = advice else {
            continue;
        };
        let of = concerned(s);
        match (found.usual, found.state) {
            (false, StateId::FREE) => steps.push(Step::new(
                "search",
                file,
                &joined(""),
                &format!("every redesign that removes all {of}, cheapest first"),
            )),
            (true, StateId::FREE) => {
                let names = USUAL.iter().map(|t| format!("\"{}\"", t.name())).join(", ");
                steps.push(Step {
                    command: format!("Write under [search]: options = [{names}]"),
                    gives:
                        "so that joints have a choice; then `ozols search` finds what removes all"
                            .to_owned(),
                });
            }
            (false, n) => {
                let left = found
                    .list
                    .first()
                    .map_or(of, |x| of.saturating_sub(x.removes));
                let state = if n == StateId::new(1) {
                    String::new()
                } else {
                    format!(" --state {}", crate::view::next::word(&s.state))
                };
                steps.push(Step::new(
                    "search",
                    file,
                    &joined(&format!("--max-external {left}{state}")),
                    &format!("redesigns that leave at most {left} of the {of} external, too"),
                ));
            }
            (true, _) if !found.list.is_empty() => steps.push(Step {
                command: format!(
                    "Write at a contact of state {}: unloading = [\"{}\"]",
                    s.state,
                    USUAL_UNLOADING.name()
                ),
                gives: "so that `ozols search` may insert it; --max-external N asks for it"
                    .to_owned(),
            }),
            (true, _) => {}
        }
    }
    if !steps.is_empty() {
        return steps;
    }
    let loaded =
        !m.loads.forces.is_empty() || !m.loads.moments.is_empty() || m.loads.gravity.is_some();
    if loaded {
        steps.push(Step::new(
            "statics",
            file,
            "",
            "the joints' reactions to its loads",
        ));
    }
    let svg = file_name(&m.name, "svg");
    steps.push(Step::new(
        "draw",
        file,
        &format!("-o {svg}"),
        "its structural scheme",
    ));
    steps
}
