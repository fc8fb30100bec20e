//! The cheapest variants of a search, scored and put in order.

use crate::model::ranking::Ranking;
use crate::score::evaluation::evaluate::{Evaluator, ScoreError};
use crate::score::outcome::proof::prove_best;
use crate::score::outcome::ranking::{Ranked, RankedPool, Ranker};
use crate::score::request::{List, Request};
use crate::search::Search;
use crate::search::answer::counts;
use crate::search::diagram::{ShouldCancel, Stop};
use crate::search::question::conditions::Symmetry;
use crate::search::solve::Diagrams;

/// Computes the scores of the cheapest variants and sorts the best, if a ranking is requested.
///
/// # Errors
/// Returns an error if the original mechanism cannot bear the loads of the ranking.
pub(in crate::score) fn rank_variants(
    search: &Search,
    diagrams: &Diagrams,
    request: &Request,
    ranking: &Ranking,
    should_cancel: ShouldCancel<'_>,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Option<RankedPool>, ScoreError> {
    let List::Top(top) = request.list else {
        return Ok(None);
    };
    let wanted = request.cheapest_scored();
    let evaluator = Evaluator::in_states(search, ranking.clearance, &ranking.states)?;
    // What may be kept of a variant: its scores, and its choices beside an allocation's own.
    let each = size_of::<Ranked>() + 32 + size_of::<usize>() * search.space.variables.len();
    let pool = wanted.min(search.conditions.memory / 4 / each).max(1);
    let top = top.min(pool);
    let mut ranker = Ranker::new(&evaluator, ranking, pool, top);
    let known = diagrams.known_up_to();
    let (mut given, mut doubtful) = (0, known.is_none());
    for v in search.cheapest_variants(diagrams, pool + 1) {
        given += 1;
        doubtful |= known.is_none_or(|k| search.steps.cost_in_milli(v.key.cost()) > k);
        if should_cancel() || ranker.take_variant(v).is_break() {
            break;
        }
    }
    let interrupted = should_cancel();
    let exhausted = diagrams.stop_reason() == Stop::Exhausted && !interrupted;
    let mut out = ranker.finish_pool(exhausted && given <= pool);
    if interrupted && !out.proven {
        (out.interrupted, out.proof, out.missing) = (true, "the ranking was interrupted", None);
    } else if doubtful {
        (out.proven, out.proof, out.missing) = (false, "the search stopped early", None);
    }
    let all = request.pool.is_none() && !out.proven && exhausted;
    if all && request.symmetry != Symmetry::OnePerOrbit {
        prove_best(
            &evaluator,
            diagrams.listed_diagram(),
            &mut out,
            top,
            should_cancel,
            progress,
        );
    }
    if let Some(missing) = out.missing.as_mut().filter(|_| exhausted) {
        let by_cost = counts::counts_by_cost(search, diagrams.listed_diagram());
        missing.cheaper = by_cost.map(|all| all.range(..missing.settled_at).map(|(_, n)| n).sum());
    }
    Ok(Some(out))
}
