//! `[ranking]` and `[joint_types]`.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::resolve::cost;
use crate::file::schema::{JointTypeEntry, MechanismFile, RankingEntry};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, Mechanism, StateId};
use crate::model::ranking::{ClearanceSum, Limit, Order, Ranking, Term, TypeOverride};
use itertools::Itertools;

/// Most terms and limits.
const MOST: usize = 100;

fn term(word: &str, at: &[DocumentStep], out: &mut Findings) -> Option<Term> {
    let found = Term::from_name(word);
    if found.is_none() {
        out.add(
            &key(at, "term"),
            ProblemKind::UnknownWord {
                what: "term",
                word: word.to_owned(),
                known: Term::ALL.iter().map(|t| t.name()).join(", "),
            },
        );
    }
    found
}

fn bad(
    out: &mut Findings,
    at: &[DocumentStep],
    what: &'static str,
    value: f64,
    allowed: &'static str,
) {
    let value = value.to_string();
    out.add(
        at,
        ProblemKind::BadQuantity {
            what,
            value,
            allowed,
        },
    );
}

/// Where `[ranking]` stands.
fn root() -> [DocumentStep; 1] {
    [DocumentStep::Key("ranking".to_owned())]
}

/// The ranking a file asks for, if any.
pub(crate) fn ranking(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> Option<Ranking> {
    let entry = file.ranking.as_ref()?;
    let order = order(entry, out);
    let clearance = clearance(entry, out);
    let terms = terms(entry, out);
    let limits = limits(entry, out);
    let states = ranked_states(entry, mechanism, out);
    Some(Ranking {
        states,
        order,
        terms,
        limits,
        clearance,
    })
}

/// How terms are weighed against each other.
fn order(entry: &RankingEntry, out: &mut Findings) -> Order {
    let word = entry.order.as_deref().unwrap_or("weighted");
    let order = Order::ALL.iter().find(|(_, w)| *w == word);
    if order.is_none() {
        out.add(
            &key(&root(), "order"),
            ProblemKind::UnknownWord {
                what: "order",
                word: word.to_owned(),
                known: Order::ALL.iter().map(|(_, w)| *w).join(", "),
            },
        );
    }
    order.map_or(Order::Weighted, |(o, _)| *o)
}

/// How clearances add up.
fn clearance(entry: &RankingEntry, out: &mut Findings) -> ClearanceSum {
    match entry.clearance.as_deref() {
        None | Some("worst") => ClearanceSum::Worst,
        Some("rms") => ClearanceSum::Rms,
        Some(word) => {
            out.add(
                &key(&root(), "clearance"),
                ProblemKind::UnknownWord {
                    what: "sum of clearances",
                    word: word.to_owned(),
                    known: "worst, rms".to_owned(),
                },
            );
            ClearanceSum::Worst
        }
    }
}

/// The terms with their weights.
fn terms(entry: &RankingEntry, out: &mut Findings) -> Vec<(Term, f64)> {
    let list = key(&root(), "terms");
    let mut terms: Vec<(Term, f64)> = Vec::new();
    let entries = out.at_most(MOST, &entry.terms, "terms", &list);
    for (i, t) in entries.iter().enumerate() {
        let at = index(&list, i);
        let weight = t.weight.unwrap_or(1.0);
        if !(0.0..=1e12).contains(&weight) {
            bad(
                out,
                &key(&at, "weight"),
                "weight",
                weight,
                "a number from 0 to 1e12",
            );
        }
        let Some(term) = term(&t.term, &at, out) else {
            continue;
        };
        if terms.iter().any(|(other, _)| *other == term) {
            out.add(
                &key(&at, "term"),
                ProblemKind::Duplicate {
                    what: "[ranking]",
                    id: t.term.clone(),
                },
            );
        }
        terms.push((term, weight));
    }
    if entry.terms.is_empty() {
        out.add(
            &list,
            ProblemKind::UnknownWord {
                what: "list of terms",
                word: "[]".to_owned(),
                known: Term::ALL.iter().map(|t| t.name()).join(", "),
            },
        );
    }
    terms
}

/// The bounds that variants must keep.
fn limits(entry: &RankingEntry, out: &mut Findings) -> Vec<Limit> {
    let list = key(&root(), "limits");
    let mut limits = Vec::new();
    let entries = out.at_most(MOST, &entry.limits, "limits", &list);
    for (i, l) in entries.iter().enumerate() {
        let at = index(&list, i);
        for (k, bound) in [("min", l.min), ("max", l.max)] {
            if let Some(x) = bound.filter(|x| !x.is_finite()) {
                bad(out, &key(&at, k), "limit", x, "a finite number");
            }
        }
        if let Some(term) = term(&l.term, &at, out) {
            let (min, max) = (l.min, l.max);
            limits.push(Limit { term, min, max });
        }
    }
    limits
}

/// The states that count in the ranking: free, and those in which the gripper holds its part.
fn ranked_states(entry: &RankingEntry, mechanism: &Mechanism, out: &mut Findings) -> Vec<StateId> {
    let grip = mechanism.loads.grip.as_ref().and_then(|g| g.contacts);
    let counts = |s: StateId| {
        let of_grip = grip.and_then(|c| mechanism.joints[c[0]].states.as_ref());
        s == StateId::FREE || of_grip.is_some_and(|states| states.contains(&s))
    };
    let list = key(&root(), "states");
    let mut states = Vec::new();
    let words = out.at_most(MOST, &entry.states, "states", &list);
    for (i, word) in words.iter().enumerate() {
        let found = mechanism.state(word);
        match found.filter(|&s| counts(s)) {
            Some(s) => states.push(s),
            None => out.add(
                &index(&list, i),
                ProblemKind::UnknownWord {
                    what: "state to rank in (free, or one with the contacts of [workload.grip])",
                    word: word.clone(),
                    known: mechanism
                        .state_ids()
                        .filter(|&s| counts(s))
                        .map(|s| mechanism.states[s].as_str())
                        .join(", "),
                },
            ),
        }
    }
    states
}

/// What a file says of joint types: of what they bear, and of what they cost in thousandths.
pub(crate) fn joint_types(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> (Vec<TypeOverride>, Vec<(String, i64)>) {
    let root = [DocumentStep::Key("joint_types".to_owned())];
    let (mut found, mut costs) = (Vec::new(), Vec::new());
    let offered = |name: &str| {
        let mut all = mechanism.joints.iter().flat_map(Joint::offered);
        all.any(|o| o.name == name)
    };
    for (name, entry) in &file.joint_types {
        let at = key(&root, name);
        if name != "custom" && JointType::from_name(name).is_none() && !offered(name) {
            let known = JointType::NAMED.iter().map(JointType::name);
            out.add(
                &at,
                ProblemKind::UnknownWord {
                    what: "joint type",
                    word: name.clone(),
                    known: known.chain(["custom"]).join(", "),
                },
            );
        }
        check_figures(entry, &at, out);
        if let Some(milli) = entry.cost.and_then(|c| cost(c, &key(&at, "cost"), out)) {
            costs.push((name.clone(), milli));
        }
        let says = TypeOverride {
            name: name.clone(),
            capacity_force: entry.capacity_force,
            capacity_moment: entry.capacity_moment,
            clearance: entry.clearance,
        };
        // An entry of a cost alone says nothing of what the type bears.
        let nothing = TypeOverride {
            name: name.clone(),
            ..TypeOverride::default()
        };
        found.extend((says != nothing).then_some(says));
    }
    (found, costs)
}

/// Whether what a type bears lies in range.
fn check_figures(entry: &JointTypeEntry, at: &[DocumentStep], out: &mut Findings) {
    for (k, what, value, least) in [
        (
            "capacity_force",
            "capacity",
            entry.capacity_force,
            f64::MIN_POSITIVE,
        ),
        (
            "capacity_moment",
            "capacity",
            entry.capacity_moment,
            f64::MIN_POSITIVE,
        ),
        ("clearance", "clearance", entry.clearance, 0.0),
    ] {
        if let Some(x) = value.filter(|x| !(least..=1e12).contains(x)) {
            let allowed = if least > 0.0 {
                "a number above 0, up to 1e12"
            } else {
                "a number from 0 to 1e12"
            };
            bad(out, &key(at, k), what, x, allowed);
        }
    }
}
