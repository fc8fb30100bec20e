//! A ranking in words and as data.

use crate::model::ranking::Term;
use crate::score::evaluation::load_cases::Gripped;
use crate::score::outcome::ranking::{Ranked, RankedPool};
use crate::view::prelude::*;

/// Maximum number of reasons.
const REASONS: usize = 10;

/// Returns the terms of a ranking, for the head of a list.
pub(crate) fn ranking_head(p: &RankedPool) -> String {
    let terms = p.ranking.terms.iter();
    let terms = terms.map(|(t, w)| format!("{w} {}", t.name())).join(" + ");
    format!("ranked under the workload, weighted: {terms}")
}

/// Describes the loads that the grip supplied.
fn describe_grip(m: &Mechanism, g: &Gripped) -> String {
    let unit = m.length_unit;
    let told = |d: &f64| four_digits(d / unit.metres);
    let some = |list: &[f64]| match list {
        [] => String::new(),
        [one] => told(one),
        [first, .., last] => format!("{} to {}", told(first), told(last)),
    };
    let lost = if g.lost.is_empty() {
        String::new()
    } else {
        format!(
            "; not held, so not counted: D = {} {}",
            some(&g.lost),
            unit.symbol
        )
    };
    format!(
        "Loads of state {} from the grip: contact forces of the worst case of {}, D = {} {}{lost}",
        m.states[g.state],
        count_noun(g.held.len(), "part"),
        some(&g.held),
        unit.symbol
    )
}

/// Returns the remarks on a list of ranked variants, a line each.
pub(crate) fn ranking_notes(m: &Mechanism, p: &RankedPool) -> Vec<String> {
    let n = |x: usize| group_thousands(x);
    let poses = match p.poses {
        0 | 1 => String::new(),
        many => format!(", each in {many} poses"),
    };
    let proven = if p.proven { "proven" } else { "not proven" };
    let others = p
        .elsewhere
        .map_or(String::new(), |others| format!(" and {} others", n(others)));
    let mut out = vec![format!(
        "The best of the {} cheapest variants{others}{poses}; {proven} the best of all: {}",
        n(p.scored),
        p.proof
    )];
    if let Some(missing) = &p.missing {
        let cheaper = missing.cheaper.as_ref().map_or(String::new(), |n| {
            format!(", as {} are", group_thousands(n))
        });
        out.push(format!(
            "How far from proven: a variant not scored has a sum of at least {}, the last here {}; one that could still \
             come before it costs less than {}{cheaper}",
            four_digits(missing.least),
            four_digits(missing.last),
            format_cost(missing.settled_at)
        ));
    }
    if !p.proven {
        let pool = typed_option("pool", "");
        out.push(format!("{pool} widens the view (now {})", n(p.pool)));
    }
    if p.ranking
        .terms
        .iter()
        .any(|(t, _)| *t == Term::Conditioning)
    {
        out.push(
            "cond. held: like cond., but with the drives locked and the worst over all poses"
                .to_owned(),
        );
    }
    let left_out = [
        (
            p.unheld,
            "rejected: not in equilibrium, because the loads move an idle freedom",
        ),
        (p.limited, "rejected: beyond a limit"),
        (
            p.open,
            "keep redundant constraints: scored by their reactions of minimum norm",
        ),
    ];
    let some = left_out.iter().filter(|(count, _)| *count > 0);
    out.extend(some.map(|(count, what)| format!("{} {what}", n(*count))));
    out.extend(p.gripped.iter().map(|g| describe_grip(m, g)));
    let stopped = p.stroke_stopped;
    out.extend(stopped.map(|at| format!("The stroke could not be followed to {at}")));
    out
}

/// Returns the reasons why the first ranked variants are not in the order of cost, one per line.
pub(crate) fn place_reasons<'a>(
    m: &'a Mechanism,
    p: &'a RankedPool,
) -> impl Iterator<Item = String> + 'a {
    let places = (1..=p.list.len()).take(REASONS);
    places.filter_map(|place| p.place_reason(m, place))
}

/// Returns the column heads of a list.
pub(crate) fn ranking_columns(p: &RankedPool) -> Vec<&'static str> {
    let terms = p.ranking.terms.iter();
    let mut out: Vec<&str> = terms.filter_map(|(t, _)| t.heading()).collect();
    out.push("score");
    out
}

/// Returns the cells of those columns.
pub(crate) fn ranking_cells(p: &RankedPool, r: &Ranked) -> Vec<String> {
    let terms = p.ranking.terms.iter().map(|(t, _)| *t);
    let mut out: Vec<String> = terms
        .filter(|t| t.heading().is_some())
        .map(|t| r.scores.term_cell(t))
        .collect();
    out.push(format!("{:.4}", r.total));
    out
}

/// Returns the ranking as data. A missing proof is described by sums, a cost, and a count as text, since it may be large.
pub(crate) fn ranking_json(m: &Mechanism, p: &RankedPool) -> Value {
    let grip =
        |g: &Gripped| json!({ "state": m.states[g.state], "held": g.held, "not_held": g.lost });
    let more = json!({
        "pool": p.pool,
        "scored": p.scored,
        "scored_elsewhere": p.elsewhere,
        "poses": p.poses,
        "grip": p.gripped.iter().map(grip).collect::<Value>(),
        "no_equilibrium": p.unheld,
        "beyond_limits": p.limited,
        "minimum_norm": p.open,
        "proven": p.proven,
        "proof": p.proof,
        "missing": p.missing.as_ref().map(|m| json!({
            "least_sum_elsewhere": m.least,
            "last_sum": m.last,
            "settled_at_cost": m.settled_at_cost(),
            "cheaper": m.cheaper.as_ref().map(ToString::to_string),
        })),
    });
    join_objects([json!(p.ranking), more])
}

/// Returns a ranked variant's own, with the reason of its place: each term's figure (the error in m), what the most loaded joints bear
/// (forces in N, moments in N·m), place by cost, sum, front and reason.
pub(crate) fn scores_json(m: &Mechanism, r: &Ranked, reason: Option<String>) -> Value {
    let mut out = json!({});
    for term in Term::ALL {
        let (key, value) = (term.about().key, r.scores.term_value(term));
        #[allow(clippy::cast_possible_truncation, reason = "a count")]
        let value = if term.about().is_count {
            json!(value as i64)
        } else {
            json!(value)
        };
        out[key] = value;
        if let Some(peak) = r.scores.term_peak(term) {
            let unit = match term {
                Term::PeakForce => "newton",
                _ => "newton-metre",
            };
            out[format!("{key}-{unit}")] = json!(peak.value);
            out[format!("{key}-joint")] = json!(m.joints.get(peak.joint.index()).map(|j| &j.id));
        }
    }
    let more = json!({
        "minimum-norm": r.scores.minimum_norm,
        "by_cost": r.by_cost,
        "total": r.total,
        "reason": reason,
    });
    join_objects([out, more])
}
