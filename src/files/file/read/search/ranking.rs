//! `[ranking]` and `[joint_types]`.

use crate::file::read::value::names::used_twice;
use crate::file::schema::{JointTypeEntry, MechanismFile, RankingEntry};
use crate::file::{Findings, Place};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, Mechanism, StateId};
use crate::model::ranking::{ClearanceSum, Limit, Order, Ranking, Term, TypeOverride};

/// Most terms and limits.
const MOST: usize = 100;

fn term(word: &str, at: &Place<'_>) -> Option<Term> {
    let found = Term::from_name(word);
    if found.is_none() {
        at.key("term")
            .unknown("term", word, Term::ALL.map(Term::name));
    }
    found
}

/// Returns the ranking that a file asks for, if any.
pub(crate) fn ranking(file: &MechanismFile, m: &Mechanism, out: &Findings) -> Option<Ranking> {
    let entry = file.ranking.as_ref()?;
    let at = &out.key("ranking");
    Some(Ranking {
        order: at.word("order", &entry.order, &Order::ALL.map(|(o, w)| (w, o))),
        clearance: clearance(entry, at),
        terms: terms(entry, &at.key("terms")),
        limits: limits(entry, &at.key("limits")),
        states: ranked_states(entry, m, &at.key("states")),
    })
}

/// Returns the rule for adding clearances.
fn clearance(entry: &RankingEntry, at: &Place<'_>) -> ClearanceSum {
    match entry.clearance.as_deref() {
        None | Some("worst") => ClearanceSum::Worst,
        Some("rms") => ClearanceSum::Rms,
        Some(word) => {
            let at = at.key("clearance");
            at.unknown("sum of clearances", word, ["worst", "rms"]);
            ClearanceSum::Worst
        }
    }
}

/// Returns the terms with their weights.
fn terms(entry: &RankingEntry, at: &Place<'_>) -> Vec<(Term, f64)> {
    let mut terms: Vec<(Term, f64)> = Vec::new();
    for (at, t) in at.most(MOST, &entry.terms, "terms") {
        let weight = t.weight.unwrap_or(1.0);
        if !(0.0..=1e12).contains(&weight) {
            at.key("weight")
                .bad("weight", weight, "a number from 0 to 1e12");
        }
        let Some(term) = term(&t.term, &at) else {
            continue;
        };
        if terms.iter().any(|(other, _)| *other == term) {
            at.key("term").add(used_twice("[ranking]", &t.term));
        }
        terms.push((term, weight));
    }
    if entry.terms.is_empty() {
        at.unknown("list of terms", "[]", Term::ALL.map(Term::name));
    }
    terms
}

/// Returns the bounds that variants must meet.
fn limits(entry: &RankingEntry, at: &Place<'_>) -> Vec<Limit> {
    let mut limits = Vec::new();
    for (at, l) in at.most(MOST, &entry.limits, "limits") {
        let (min, max) = (l.min, l.max);
        for (k, bound) in [("min", min), ("max", max)] {
            if let Some(x) = bound.filter(|x| !x.is_finite()) {
                at.key(k).bad("limit", x, "a finite number");
            }
        }
        limits.extend(term(&l.term, &at).map(|term| Limit { term, min, max }));
    }
    limits
}

/// Returns the states that count in the ranking: free, and those in which the gripper holds its part.
fn ranked_states(entry: &RankingEntry, m: &Mechanism, at: &Place<'_>) -> Vec<StateId> {
    let grip = m.loads.grip.as_ref().and_then(|g| g.contacts);
    let of_grip = grip.and_then(|c| m.joints[c[0]].states.as_ref());
    let counts = |s: &StateId| *s == StateId::FREE || of_grip.is_some_and(|all| all.contains(s));
    let mut states = Vec::new();
    for (at, word) in at.most(MOST, &entry.states, "states") {
        let found = m.state(word).filter(counts);
        if found.is_none() {
            let what = "state to rank in (free, or one with the contacts of [workload.grip])";
            at.unknown(
                what,
                word,
                m.state_ids().filter(counts).map(|s| &m.states[s]),
            );
        }
        states.extend(found);
    }
    states
}

/// Returns the figures of joint types in a file: their capacities, and their costs in thousandths.
pub(crate) fn joint_types(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &Findings,
) -> (Vec<TypeOverride>, Vec<(String, i64)>) {
    let (mut found, mut costs) = (Vec::new(), Vec::new());
    let offered = |name: &str| {
        let mut all = mechanism.joints.iter().flat_map(Joint::offered);
        all.any(|o| o.name == name)
    };
    for (name, entry) in &file.joint_types {
        let at = out.key("joint_types").key(name);
        let name = if offered(name) {
            name
        } else {
            JointType::word(name)
        };
        if name != "custom" && JointType::from_name(name).is_none() && !offered(name) {
            let known = JointType::NAMED.iter().map(JointType::name);
            at.unknown("joint type", name, known.chain(["custom"]));
        }
        check_figures(entry, &at);
        let milli = entry.cost.and_then(|c| at.key("cost").cost(c));
        costs.extend(milli.map(|milli| (name.to_owned(), milli)));
        let says = TypeOverride {
            name: name.to_owned(),
            capacity_force: entry.capacity_force,
            capacity_moment: entry.capacity_moment,
            clearance: entry.clearance,
        };
        // An entry of a cost alone says nothing of what the type bears.
        let nothing = TypeOverride {
            name: name.to_owned(),
            ..TypeOverride::default()
        };
        found.extend((says != nothing).then_some(says));
    }
    (found, costs)
}

/// Checks that the capacities of a type are in range.
fn check_figures(entry: &JointTypeEntry, at: &Place<'_>) {
    let above = (f64::MIN_POSITIVE, "a number above 0, up to 1e12");
    for (k, what, value, (least, allowed)) in [
        ("capacity_force", "capacity", entry.capacity_force, above),
        ("capacity_moment", "capacity", entry.capacity_moment, above),
        (
            "clearance",
            "clearance",
            entry.clearance,
            (0.0, "a number from 0 to 1e12"),
        ),
    ] {
        if let Some(x) = value.filter(|x| !(least..=1e12).contains(x)) {
            at.key(k).bad(what, x, allowed);
        }
    }
}
