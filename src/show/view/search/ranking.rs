//! A ranking in words and as data.

use crate::format::{cost, grouped, plural, significant};
use crate::model::mechanism::{Joint, Mechanism};
use crate::model::ranking::{Order, Ranking, Term};
use crate::score::evaluation::load_cases::Gripped;
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::ranking::{Ranked, RankedPool};
use itertools::Itertools;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// Reasons told at most.
const REASONS: usize = 10;

/// What variants are ranked by, for the head of a list.
#[must_use]
pub(crate) fn head(p: &RankedPool) -> String {
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
pub(crate) fn notes(m: &Mechanism, p: &RankedPool) -> Vec<String> {
    let n = |x: usize| grouped(x);
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
        let cheaper = missing
            .cheaper
            .as_ref()
            .map_or(String::new(), |n| format!(", as {} are", grouped(n)));
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
            "left out: no equilibrium, since the loads move an idle freedom",
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
pub(crate) fn reasons<'a>(
    m: &'a Mechanism,
    p: &'a RankedPool,
) -> impl Iterator<Item = String> + 'a {
    let places = (1..=p.list.len()).take(REASONS);
    places.filter_map(|place| p.reason(m, place))
}

/// Heads of the columns of a list.
#[must_use]
pub(crate) fn columns(p: &RankedPool) -> Vec<&'static str> {
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
pub(crate) fn cells(p: &RankedPool, r: &Ranked) -> Vec<String> {
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
#[derive(Debug, serde::Serialize)]
pub(crate) struct RankingData<'a> {
    #[serde(flatten)]
    ranking: &'a Ranking,
    pool: usize,
    scored: usize,
    scored_elsewhere: Option<usize>,
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
#[derive(Debug, serde::Serialize)]
struct MissingData {
    least_sum_elsewhere: f64,
    last_sum: f64,
    settled_at_cost: f64,
    cheaper: Option<String>,
}

#[derive(Debug, serde::Serialize)]
struct GripData<'a> {
    state: &'a str,
    held: &'a [f64],
    not_held: &'a [f64],
}

impl<'a> RankingData<'a> {
    /// Of a ranked pool.
    #[must_use]
    pub(crate) fn new(m: &'a Mechanism, p: &'a RankedPool) -> Self {
        let grip = p.gripped.iter().map(|g| GripData {
            state: &m.states[g.state],
            held: &g.held,
            not_held: &g.lost,
        });
        RankingData {
            ranking: &p.ranking,
            pool: p.pool,
            scored: p.scored,
            scored_elsewhere: p.elsewhere,
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

/// A ranked variant's own: each term's figure (the error in m), what the most loaded joints bear (forces in N, moments in
/// N·m), place by cost, sum, front and reason.
#[derive(Debug)]
pub(crate) struct RankedData<'a> {
    scores: &'a Scores,
    joints: &'a [Joint],
    by_cost: usize,
    total: Option<f64>,
    front: Option<usize>,
    reason: Option<String>,
}

impl<'a> RankedData<'a> {
    /// Of a ranked variant, with the reason of its place.
    #[must_use]
    pub(crate) fn new(m: &'a Mechanism, r: &'a Ranked, reason: Option<String>) -> Self {
        RankedData {
            scores: &r.scores,
            joints: &m.joints,
            by_cost: r.by_cost,
            total: r.total,
            front: r.front,
            reason,
        }
    }
}

impl Serialize for RankedData<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for term in Term::ALL {
            let (about, value) = (term.about(), self.scores.value(term));
            if about.is_count {
                #[allow(clippy::cast_possible_truncation, reason = "a count")]
                map.serialize_entry(about.key, &(value as i64))?;
            } else {
                map.serialize_entry(about.key, &value)?;
            }
            if let Some(peak) = self.scores.peak(term) {
                let unit = match term {
                    Term::PeakForce => "newton",
                    _ => "newton-metre",
                };
                map.serialize_entry(&format!("{}-{unit}", about.key), &peak.value)?;
                let joint = self.joints.get(peak.joint.index());
                map.serialize_entry(&format!("{}-joint", about.key), &joint.map(|j| &j.id))?;
            }
        }
        map.serialize_entry("minimum-norm", &self.scores.minimum_norm)?;
        map.serialize_entry("by_cost", &self.by_cost)?;
        map.serialize_entry("total", &self.total)?;
        map.serialize_entry("front", &self.front)?;
        map.serialize_entry("reason", &self.reason)?;
        map.end()
    }
}
