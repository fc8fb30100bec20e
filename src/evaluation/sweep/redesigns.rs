//! The best redesigns at a sample, told by what they change, so that those of different samples can be compared.

use crate::model::mechanism::Mechanism;
use crate::model::ranking::{ClearanceSum, Order};
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::Outcome;
use crate::score::outcome::ranking::{Ranked, RankedPool};
use crate::score::outcome::variant::{changes, in_words};
use crate::score::request::{Check, List, Request};
use crate::score::run::{RunError, run};
use crate::search::answer::k_best::Assignment;
use crate::sweep::forces::{is_loaded, rounded};
use serde::{Deserialize, Serialize};

/// Most redesigns that share the first place and are all told.
pub(crate) const TIED: usize = 100;

/// The redesigns of a sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SampleRedesigns {
    /// How many have no more redundant constraints than allowed, in digits.
    pub determinate: String,
    /// How many meet every condition, in digits.
    pub admissible: String,
    /// Whether the counts are exact; lower bounds otherwise.
    pub exact: bool,
    /// Whether nothing else can share the first place or take it.
    pub proven: bool,
    /// What those that share the first place change, in words, ascending.
    pub best: Vec<String>,
    /// The best, in order.
    pub ranking: Vec<Redesign>,
}

/// A redesign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Redesign {
    /// What it changes.
    pub changes: String,
    /// Its cost above the present mechanism's.
    pub cost: f64,
    /// W.
    pub mobility: i64,
    /// Its weighted sum, where it is ranked by one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub total: Option<f64>,
    /// The greatest force of a joint over what it bears, over the poses looked at `[N]`, and the joint; where there are loads
    /// that it holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak_force: Option<(f64, String)>,
}

/// The search that is made: what is asked of the variants, and nothing that is told of them beside.
pub(super) fn as_searched(request: &Request, listed: usize) -> Request {
    Request {
        list: List::Top(listed),
        check: Check::Prime,
        distinct: false,
        poses: 0,
        generic_only: false,
        pool: Some(request.cheapest_scored()),
        seed: 1,
        ..request.clone()
    }
}

/// Searches a mechanism.
///
/// # Errors
/// Where it cannot be searched as asked.
pub(super) fn redesigns(
    m: &Mechanism,
    request: &Request,
    top: usize,
) -> Result<SampleRedesigns, RunError> {
    let listed = top.max(TIED + 1);
    let request = &as_searched(request, listed);
    let outcome = run(m.clone(), request, &|| false, &mut |_| {})?;
    let cheapest: Option<Vec<Assignment>> = match (&outcome.numeric, &outcome.diagrams) {
        (Some(found), _) => Some(found.list(&outcome.search).take(listed).collect()),
        (None, Some(diagrams)) => Some(outcome.search.cheapest(diagrams, listed).collect()),
        (None, None) => None,
    };
    let (proven, tied, list) = match (&outcome.ranking, cheapest) {
        (Some(pool), _) => ranked(pool),
        (None, Some(list)) => {
            let cost = |v: &Assignment| outcome.search.steps.milli(v.key.cost());
            let first = list.first().map(cost);
            let tied = list.iter().take_while(|v| Some(cost(v)) == first).count();
            let known = outcome.known_up_to();
            let proven = known.is_some_and(|known| first.is_none_or(|c| c <= known));
            (proven, tied, list.into_iter().map(|v| (v, None)).collect())
        }
        (None, None) => (false, 0, Vec::new()),
    };
    let words = |v: &Assignment| in_words(&outcome.search, &changes(&outcome.search, v));
    let mut best: Vec<String> = list
        .iter()
        .take(tied.min(TIED))
        .map(|(v, _)| words(v))
        .collect();
    best.sort_unstable();
    Ok(SampleRedesigns {
        determinate: outcome.determinate.total.to_string(),
        admissible: outcome.admissible.total.to_string(),
        exact: outcome.is_exact(),
        proven: proven && tied <= TIED,
        best,
        ranking: told(m, &outcome, &list[..top.min(list.len())], &words),
    })
}

/// Variants with their places in a ranking, where they have one.
type Listed<'o> = Vec<(Assignment, Option<&'o Ranked>)>;

/// The list of a ranking, and how many share its first place.
fn ranked(pool: &RankedPool) -> (bool, usize, Listed<'_>) {
    let ranking = &pool.ranking;
    let alike = |a: &Ranked, b: &Ranked| match ranking.order {
        Order::Weighted => a.scores.weighted(ranking) == b.scores.weighted(ranking),
        Order::Lexicographic => {
            let mut terms = ranking.terms.iter();
            terms.all(|(t, _)| a.scores.loss(*t) == b.scores.loss(*t))
        }
        Order::Pareto => a.front == b.front,
    };
    let tied = match pool.list.first() {
        None => 0,
        Some(first) => pool.list.iter().take_while(|r| alike(first, r)).count(),
    };
    let list = pool.list.iter().map(|r| (r.variant.clone(), Some(r)));
    (pool.proven, tied, list.collect())
}

/// The first of a list, with their peak forces.
fn told(
    m: &Mechanism,
    outcome: &Outcome,
    list: &[(Assignment, Option<&Ranked>)],
    words: &dyn Fn(&Assignment) -> String,
) -> Vec<Redesign> {
    let search = &outcome.search;
    let loaded = is_loaded(m) && !list.is_empty();
    let evaluator = loaded
        .then(|| Evaluator::in_states(search, ClearanceSum::Worst, &[]).ok())
        .flatten();
    let mut scratch = Scratch::default();
    let mut one = |(v, ranked): &(Assignment, Option<&Ranked>)| {
        let scores: Option<Scores> = match (ranked, &evaluator) {
            (Some(r), _) => Some(r.scores),
            (None, Some(e)) => e.scores(v, &mut scratch).ok(),
            (None, None) => None,
        };
        let peak = scores.filter(|s| loaded && s.force.value > 0.0);
        Redesign {
            changes: words(v),
            #[allow(clippy::cast_precision_loss, reason = "costs are small")]
            cost: search.steps.milli(v.key.cost()) as f64 / 1000.0,
            mobility: search.mobility(v.key),
            total: ranked.and_then(|r| r.total).map(rounded),
            peak_force: peak.map(|s| {
                let joint = m.joints[s.force.joint].id.clone();
                (rounded(s.force.value), joint)
            }),
        }
    };
    list.iter().map(&mut one).collect()
}
