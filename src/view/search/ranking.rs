//! A ranking in words and as data.

use crate::format::number::{cost, grouped, significant};
use crate::format::phrase::plural;
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::ranking::{ClearanceSum, Order, Term};
use crate::score::cases::Gripped;
use crate::score::ranking::{Ranked, RankedPool};
use itertools::Itertools;
use serde::Serialize;

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

/// What a list of ranked variants rests on, a line each.
#[must_use]
pub fn notes(m: &Mechanism, p: &RankedPool) -> Vec<String> {
    let n = |x: usize| grouped(&x.to_string());
    let poses = match p.poses {
        0 | 1 => String::new(),
        many => format!(", each in {many} poses"),
    };
    let proven = if p.proven { "proven" } else { "not proven" };
    let mut out = vec![format!(
        "The best of the {} cheapest variants{poses}; {proven} the best of all: {}",
        n(p.scored),
        p.proof
    )];
    if let Some(missing) = &p.missing {
        let cheaper = missing.cheaper.as_ref().map_or(String::new(), |n| {
            format!(", as {} are", grouped(&n.to_string()))
        });
        out.push(format!(
            "How far from proven: a variant not scored has a sum of at least {}, the last here {}; one that could still \
             come before it costs less than {}{cheaper}",
            significant(missing.least),
            significant(missing.last),
            cost(missing.settled_at)
        ));
    }
    if !p.proven {
        out.push(format!("--pool widens the view (now {})", n(p.pool)));
    }
    if p.ranking
        .terms
        .iter()
        .any(|(t, _)| *t == Term::Conditioning)
    {
        out.push("cond. held: as cond., the smallest singular value over the largest, but with the drives held and over all poses".to_owned());
    }
    let left_out = [
        (
            p.unheld,
            "left out: no equilibrium, an idle freedom gives way under the loads",
        ),
        (p.limited, "left out: beyond a limit"),
        (
            p.open,
            "keep redundant constraints: scored by their reactions of minimum norm",
        ),
    ];
    let some = left_out.iter().filter(|(count, _)| *count > 0);
    out.extend(some.map(|(count, what)| format!("{} {what}", n(*count))));
    out.extend(p.gripped.iter().map(|g| gripped(m, g)));
    let stopped = p.stroke_stopped;
    out.extend(stopped.map(|at| format!("The stroke could not be followed to {at}")));
    out
}

/// Why the first of a list of ranked variants are not in the order of cost, a line each.
pub fn reasons<'a>(m: &'a Mechanism, p: &'a RankedPool) -> impl Iterator<Item = String> + 'a {
    let places = (1..=p.list.len()).take(REASONS);
    places.filter_map(|place| p.reason(m, place))
}

/// Heads of the columns of a list.
#[must_use]
pub fn columns(p: &RankedPool) -> Vec<&'static str> {
    let terms = p.ranking.terms.iter();
    let mut out: Vec<&str> = terms.filter_map(|(t, _)| t.heading()).collect();
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
        .filter(|t| t.heading().is_some())
        .map(|t| r.scores.cell(t))
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
    missing: Option<MissingData>,
}

/// What is missing to a proof: sums, a cost, and a count as text, since it may be large.
#[derive(Debug, Serialize)]
struct MissingData {
    least_sum_elsewhere: f64,
    last_sum: f64,
    settled_at_cost: f64,
    cheaper: Option<String>,
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
            missing: p.missing.as_ref().map(|m| MissingData {
                least_sum_elsewhere: m.least,
                last_sum: m.last,
                settled_at_cost: m.settled_at_cost(),
                cheaper: m.cheaper.as_ref().map(ToString::to_string),
            }),
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
    harmful: u32,
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
            harmful: s.harmful,
            minimum_norm: s.minimum_norm,
            by_cost: r.by_cost,
            total: r.total,
            front: r.front,
            reason,
        }
    }
}
