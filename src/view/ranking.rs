//! A ranking in words and as data.

use crate::format::number::{grouped, significant};
use crate::format::phrase::plural;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::ranking::{ClearanceSum, Order, Term};
use crate::score::cases::Gripped;
use crate::score::ranking::{Ranked, RankedPool};
use crate::score::terms::Scores;
use itertools::Itertools;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// Reasons told at most.
const REASONS: usize = 10;

/// What variants are ranked by, for the head of a list.
#[must_use]
pub fn head(p: &RankedPool) -> String {
    let terms = match p.ranking.order {
        Order::Weighted => p
            .ranking
            .terms
            .iter()
            .map(|(t, w)| format!("{w} {}", t.name()))
            .join(" + "),
        Order::Lexicographic => p
            .ranking
            .terms
            .iter()
            .map(|(t, _)| t.name())
            .join(", then "),
        Order::Pareto => p.ranking.terms.iter().map(|(t, _)| t.name()).join(", "),
    };
    format!(
        "ranked under the workload, {}: {terms}",
        p.ranking.order.name()
    )
}

/// What loads came from the grip.
fn gripped(m: &Mechanism, g: &Gripped) -> String {
    let unit = m.length_unit;
    let told = |d: &f64| significant(d / unit.metres);
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
        plural(g.held.len(), "part"),
        some(&g.held),
        unit.symbol
    )
}

/// What a list of ranked variants rests on, and why its order is not that of cost.
#[must_use]
pub fn notes(m: &Mechanism, p: &RankedPool) -> String {
    let mut out = String::new();
    let n = |x: usize| grouped(&x.to_string());
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "\n  The best of the {} cheapest variants{}; {}: {}",
        n(p.scored),
        if p.poses > 1 {
            format!(", each in {} poses", p.poses)
        } else {
            String::new()
        },
        if p.proven {
            "proven the best of all"
        } else {
            "not proven the best of all"
        },
        p.proof
    );
    if !p.proven {
        let _ = writeln!(out, "  --pool widens the view (now {})", n(p.pool));
    }
    if p.unheld > 0 {
        let _ = writeln!(
            out,
            "  {} left out: no equilibrium, an idle freedom gives way under the loads",
            n(p.unheld)
        );
    }
    if p.limited > 0 {
        let _ = writeln!(out, "  {} left out: beyond a limit", n(p.limited));
    }
    if p.open > 0 {
        let _ = writeln!(
            out,
            "  {} keep redundant constraints: scored by their reactions of minimum norm",
            n(p.open)
        );
    }
    for g in &p.gripped {
        let _ = writeln!(out, "  {}", gripped(m, g));
    }
    if let Some(at) = p.stroke_stopped {
        let _ = writeln!(out, "  The stroke could not be followed to {at}");
    }
    for i in (1..=p.list.len()).take(REASONS) {
        if let Some(reason) = p.reason(m, i) {
            let _ = writeln!(out, "  {reason}");
        }
    }
    out
}

/// Heads of the columns of a list.
#[must_use]
pub fn columns(p: &RankedPool) -> Vec<&'static str> {
    let terms = p.ranking.terms.iter().map(|(t, _)| *t);
    let mut out: Vec<&str> = terms
        .filter(|t| *t != Term::Cost)
        .map(|t| match t {
            Term::PeakForce => "force",
            Term::PeakMoment => "moment",
            Term::Conditioning => "condit.",
            Term::OutputError => "error, mm",
            Term::Changes => "changed",
            Term::Cost | Term::Idle => t.name(),
        })
        .collect();
    match p.ranking.order {
        Order::Weighted => out.push("score"),
        Order::Pareto => out.push("front"),
        Order::Lexicographic => {}
    }
    out
}

/// The cells of those columns.
#[must_use]
pub fn cells(p: &RankedPool, r: &Ranked) -> Vec<String> {
    let terms = p.ranking.terms.iter().map(|(t, _)| *t);
    let mut out: Vec<String> = terms
        .filter(|t| *t != Term::Cost)
        .map(|t| match t {
            Term::OutputError => format!("{:.4}", 1e3 * r.scores.output_error),
            Term::Changes | Term::Idle => r.scores.value(t).to_string(),
            _ => format!("{:.4}", r.scores.value(t)),
        })
        .collect();
    match p.ranking.order {
        Order::Weighted => out.push(r.total.map_or(String::new(), |x| format!("{x:.4}"))),
        Order::Pareto => out.push(r.front.map_or(String::new(), |x| x.to_string())),
        Order::Lexicographic => {}
    }
    out
}

/// All scores of a variant: forces in N, moments in N·m, the error in m.
#[must_use]
pub fn scores(m: &Mechanism, s: &Scores) -> Map<String, Value> {
    let joint = |j: JointId| m.joints.get(j.index()).map(|j| j.id.as_str());
    let all = json!({
        "peak-force": s.force.utilisation,
        "peak-force-newton": s.force.value,
        "peak-force-joint": joint(s.force.joint),
        "peak-moment": s.moment.utilisation,
        "peak-moment-newton-metre": s.moment.value,
        "peak-moment-joint": joint(s.moment.joint),
        "conditioning": s.conditioning,
        "output-error": s.output_error,
        "changes": s.changes,
        "cost": s.value(Term::Cost),
        "idle": s.idle,
        "minimum-norm": s.minimum_norm,
    });
    match all {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// A ranked variant's own: scores, place by cost, sum, front and reason.
#[must_use]
pub fn variant(m: &Mechanism, p: &RankedPool, r: &Ranked, position: usize) -> Map<String, Value> {
    let mut out = scores(m, &r.scores);
    out.insert("by_cost".to_owned(), json!(r.by_cost));
    out.insert("total".to_owned(), json!(r.total));
    out.insert("front".to_owned(), json!(r.front));
    out.insert("reason".to_owned(), json!(p.reason(m, position)));
    out
}

/// The ranking as data.
#[must_use]
pub fn json(m: &Mechanism, p: &RankedPool) -> Value {
    json!({
        "order": p.ranking.order.name(),
        "terms": p.ranking.terms.iter()
            .map(|(t, w)| json!({"term": t.name(), "weight": w})).collect::<Vec<_>>(),
        "limits": p.ranking.limits.iter()
            .map(|l| json!({"term": l.term.name(), "min": l.min, "max": l.max})).collect::<Vec<_>>(),
        "clearance": match p.ranking.clearance {
            ClearanceSum::Worst => "worst",
            ClearanceSum::Rms => "rms",
        },
        "pool": p.pool,
        "scored": p.scored,
        "poses": p.poses,
        "grip": p.gripped.iter()
            .map(|g| json!({"state": m.states[g.state], "held": g.held, "not_held": g.lost})).collect::<Vec<_>>(),
        "no_equilibrium": p.unheld,
        "beyond_limits": p.limited,
        "minimum_norm": p.open,
        "proven": p.proven,
        "proof": p.proof,
    })
}
