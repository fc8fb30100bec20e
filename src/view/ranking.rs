//! A ranking in words and as data.

use crate::format::number::{grouped, significant};
use crate::format::phrase::plural;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::ranking::{ClearanceSum, Order, Term};
use crate::score::cases::Gripped;
use crate::score::ranking::{Ranked, RankedPool};
use itertools::Itertools;
use serde::Serialize;
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
    let by = |term| p.ranking.terms.iter().any(|(t, _)| *t == term);
    if by(Term::Conditioning) {
        let _ = writeln!(
            out,
            "  cond. held: as cond., the smallest singular value over the largest, but with the drives held and over all poses"
        );
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
            Term::Conditioning => "cond. held",
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

/// The ranking as data.
#[derive(Debug, Serialize)]
pub struct RankingData<'a> {
    order: &'static str,
    terms: Vec<TermData>,
    limits: Vec<LimitData>,
    clearance: &'static str,
    pool: usize,
    scored: usize,
    poses: usize,
    grip: Vec<GripData<'a>>,
    no_equilibrium: usize,
    beyond_limits: usize,
    minimum_norm: usize,
    proven: bool,
    proof: &'static str,
}

#[derive(Debug, Serialize)]
struct TermData {
    term: &'static str,
    weight: f64,
}

#[derive(Debug, Serialize)]
struct LimitData {
    term: &'static str,
    min: Option<f64>,
    max: Option<f64>,
}

#[derive(Debug, Serialize)]
struct GripData<'a> {
    state: &'a str,
    held: &'a [f64],
    not_held: &'a [f64],
}

impl<'a> RankingData<'a> {
    /// Of a ranked pool.
    #[must_use]
    pub fn new(m: &'a Mechanism, p: &'a RankedPool) -> Self {
        let terms = p.ranking.terms.iter().map(|(t, weight)| TermData {
            term: t.name(),
            weight: *weight,
        });
        let limits = p.ranking.limits.iter().map(|l| LimitData {
            term: l.term.name(),
            min: l.min,
            max: l.max,
        });
        let grip = p.gripped.iter().map(|g| GripData {
            state: &m.states[g.state],
            held: &g.held,
            not_held: &g.lost,
        });
        RankingData {
            order: p.ranking.order.name(),
            terms: terms.collect(),
            limits: limits.collect(),
            clearance: match p.ranking.clearance {
                ClearanceSum::Worst => "worst",
                ClearanceSum::Rms => "rms",
            },
            pool: p.pool,
            scored: p.scored,
            poses: p.poses,
            grip: grip.collect(),
            no_equilibrium: p.unheld,
            beyond_limits: p.limited,
            minimum_norm: p.open,
            proven: p.proven,
            proof: p.proof,
        }
    }
}

/// A ranked variant's own: scores (forces in N, moments in N·m, the error in m), place by cost, sum, front and reason.
#[derive(Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub struct RankedData<'a> {
    peak_force: f64,
    peak_force_newton: f64,
    peak_force_joint: Option<&'a str>,
    peak_moment: f64,
    peak_moment_newton_metre: f64,
    peak_moment_joint: Option<&'a str>,
    conditioning: f64,
    output_error: f64,
    changes: u32,
    cost: f64,
    idle: i64,
    minimum_norm: bool,
    #[serde(rename = "by_cost")]
    by_cost: usize,
    total: Option<f64>,
    front: Option<usize>,
    reason: Option<String>,
}

impl<'a> RankedData<'a> {
    /// Of a ranked variant, with the reason of its place.
    #[must_use]
    pub fn new(m: &'a Mechanism, r: &Ranked, reason: Option<String>) -> Self {
        let joint = |j: JointId| m.joints.get(j.index()).map(|j| j.id.as_str());
        let s = &r.scores;
        RankedData {
            peak_force: s.force.utilisation,
            peak_force_newton: s.force.value,
            peak_force_joint: joint(s.force.joint),
            peak_moment: s.moment.utilisation,
            peak_moment_newton_metre: s.moment.value,
            peak_moment_joint: joint(s.moment.joint),
            conditioning: s.conditioning,
            output_error: s.output_error,
            changes: s.changes,
            cost: s.value(Term::Cost),
            idle: s.idle,
            minimum_norm: s.minimum_norm,
            by_cost: r.by_cost,
            total: r.total,
            front: r.front,
            reason,
        }
    }
}
