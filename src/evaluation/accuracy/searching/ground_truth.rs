//! What ways of searching are judged by, from a prime that none of them uses.

use crate::accuracy::searching::brute_judgement::{self, Cells, JudgedVariant, Properties};
use crate::accuracy::searching::record::Share;
use crate::geom::exact::ExactError;
use crate::model::mechanism::Mechanism;
use crate::rank::exact::field::exact_field;
use crate::score::outcome::Outcome;
use crate::score::request::Request;
use crate::score::run::{RunError, run};
use crate::search::Search;
use crate::search::answer::k_best::Assignment;
use crate::search::build::Diagrams;
use crate::search::check::brute::Matrices;
use crate::search::diagram::Stop;
use num_bigint::BigUint;
use std::collections::BTreeMap;

/// How much to do.
#[derive(Debug, Clone, Copy)]
pub struct TrialEffort {
    /// Variants that brute force looks at; a larger space is sampled.
    pub looked: usize,
    /// The pool that a ranking is judged by; `None` where all that could be among the best are gone through.
    pub pool: Option<usize>,
}

/// The prime of the truth, counted from 0: searches use the first two.
const PRIME: usize = 2;

/// The best, in truth.
enum Best {
    /// By cost: variants of equal properties are equally good.
    Cheapest(Vec<Properties>),
    /// By a ranking.
    Ranked(Vec<Vec<usize>>),
}

/// The truth about a mechanism.
pub(super) struct Truth {
    /// The search over the prime of the truth.
    pub(super) search: Search,
    matrices: Matrices,
    /// Variants looked at one by one: all, or half of them drawn from all and half from the admissible ones.
    pub(super) looked: Vec<Vec<usize>>,
    /// Whether those are all.
    pub(super) whole: bool,
    /// How many are determinate, and how many admissible.
    pub(super) found: Option<[BigUint; 2]>,
    /// How many of the best are asked for.
    pub(super) top: usize,
    /// The pool of the ranking, and whether no variant outside of it can win.
    pub(super) pool: Option<(usize, bool)>,
    judged: Vec<Option<JudgedVariant>>,
    cells: Option<Cells>,
    best: Option<Best>,
}

impl Truth {
    /// The truth about the mechanism and the conditions of an outcome. A ranking is made over the largest pool.
    pub(super) fn new(
        outcome: &Outcome,
        mechanism: &Mechanism,
        request: &Request,
        top: usize,
        effort: TrialEffort,
    ) -> Result<Truth, RunError> {
        let search = over(&outcome.search, PRIME)?;
        let matrices = Matrices::new(&search);
        let judge =
            |choices: &[usize]| brute_judgement::judged(&search, choices, matrices.look(choices));
        let (looked, diagrams) = looked_at(&search, effort.looked, request.seed);
        let judged = brute_judgement::judge_all(&looked, judge)?;
        let (cells, cheapest) = match &diagrams {
            None => {
                let best = brute_judgement::cheapest(&search, &looked, &judged, top);
                (Some(brute_judgement::cells(&search, &judged)), best)
            }
            Some(d) if d.stop() == Stop::Exhausted => {
                let cells = cells_of_diagrams(&search, d);
                (Some(cells), search.cheapest(d, top).collect())
            }
            Some(_) => (None, Vec::new()),
        };
        let (mut pool, mut best) = (None, None);
        if outcome.ranking.is_some() {
            let request = Request {
                pool: effort.pool,
                ..request.clone()
            };
            let (all, list) = listed(mechanism, &request)?;
            pool = all.ranking.as_ref().map(|r| (r.scored, r.proven));
            // A pool is no judge of itself: outside of it may be better ones.
            let ranked = || Best::Ranked(list.into_iter().map(|a| a.choices).collect());
            best = pool.is_some_and(|(_, proven)| proven).then(ranked);
        } else if cells.is_some() {
            let of = |a: &Assignment| brute_judgement::properties(&search, a.key);
            best = Some(Best::Cheapest(cheapest.iter().map(of).collect()));
        }
        let total = |cells: &Cells, which| {
            let of = cells.iter().filter(|(k, _)| k.0 == which);
            of.map(|(_, n)| n).sum::<BigUint>()
        };
        Ok(Truth {
            found: cells.as_ref().map(|c| [total(c, false), total(c, true)]),
            whole: diagrams.is_none(),
            top,
            pool,
            judged,
            cells,
            best,
            looked,
            matrices,
            search,
        })
    }

    /// The same search over a prime.
    pub(super) fn over(&self, nth: usize) -> Result<Search, RunError> {
        over(&self.search, nth)
    }

    /// How many of all counts, those there are in truth and those a way has, are equal.
    pub(super) fn counts_right(&self, found: &Cells) -> Option<Share> {
        Some(equal_counts(self.cells.as_ref()?, found))
    }

    /// How many of the best a list has. A variant that is not admissible in truth is none of them.
    pub(super) fn best_right(&self, list: &[Assignment]) -> Result<Option<Share>, ExactError> {
        let Some(best) = &self.best else {
            return Ok(None);
        };
        let (right, of) = match best {
            Best::Ranked(best) => {
                let given = best
                    .iter()
                    .filter(|b| list.iter().any(|a| a.choices == **b));
                (given.count(), best.len())
            }
            Best::Cheapest(best) => {
                let seen = |a: &Assignment| self.matrices.look(&a.choices);
                let truth =
                    |a: &Assignment| brute_judgement::judged(&self.search, &a.choices, seen(a));
                let judged = list.iter().map(truth).collect::<Result<Vec<_>, _>>()?;
                let good = judged.into_iter().flatten().filter(|j| j.admissible);
                let mut left: BTreeMap<Properties, usize> = BTreeMap::new();
                good.for_each(|j| {
                    *left
                        .entry(brute_judgement::properties(&self.search, j.key))
                        .or_default() += 1
                });
                let given = best.iter().filter(|p| match left.get_mut(p) {
                    Some(n) if *n > 0 => {
                        *n -= 1;
                        true
                    }
                    _ => false,
                });
                (given.count(), best.len())
            }
        };
        Ok(Some(Share { right, of }))
    }

    /// How many of the variants looked at are judged rightly: whether determinate, with which σ, and whether admissible.
    pub(super) fn variants_right(&self, judged: &[Option<JudgedVariant>]) -> Share {
        let verdict = |j: &Option<JudgedVariant>| j.map(|j| (j.key.internal(), j.admissible));
        let pairs = self.judged.iter().zip(judged);
        Share {
            right: pairs.filter(|(a, b)| verdict(a) == verdict(b)).count(),
            of: self.judged.len(),
        }
    }
}

/// The variants to look at one by one: all; or, where they are too many, some drawn from all and some from the admissible ones
/// of the diagrams, which come along.
fn looked_at(search: &Search, most: usize, seed: u64) -> (Vec<Vec<usize>>, Option<Diagrams>) {
    if let Some(all) = brute_judgement::every(search, most) {
        return (all, None);
    }
    let diagrams = search.build(&|| false, &mut |_| {});
    let mut some = brute_judgement::drawn(search, most.div_ceil(2), seed);
    let good = search.sample(&diagrams, seed);
    let good: Vec<_> = good.take(most / 2).collect();
    some.extend(good.into_iter().map(|a| a.choices));
    (some, Some(diagrams))
}

/// All counts of whole diagrams.
fn cells_of_diagrams(search: &Search, diagrams: &Diagrams) -> Cells {
    let counts = [(false, &diagrams.determinate), (true, &diagrams.admissible)];
    let of = counts.into_iter().flat_map(|(all, diagram)| {
        let counts = search.counts(diagram, all).by_mobility_and_changes;
        counts.into_iter().map(move |((w, c), n)| ((all, w, c), n))
    });
    of.collect()
}

/// Searches by the diagram, and gives the list that was asked for.
pub(super) fn listed(
    mechanism: &Mechanism,
    request: &Request,
) -> Result<(Outcome, Vec<Assignment>), RunError> {
    let outcome = run(mechanism.clone(), request, &|| false, &mut |_| {})?;
    let list = outcome.variants().map(|v| v.assignment().clone());
    let list = list.collect();
    Ok((outcome, list))
}

/// A search over another prime.
fn over(search: &Search, nth: usize) -> Result<Search, RunError> {
    let field = exact_field(&search.mechanism, nth)?;
    let conditions = search.conditions.clone();
    Ok(Search::new(field, search.mechanism.clone(), conditions)?)
}

/// How many of all counts, those there are in truth and those found, are equal.
fn equal_counts(truth: &Cells, found: &Cells) -> Share {
    let only = found.keys().filter(|k| !truth.contains_key(k)).count();
    let right = truth.iter().filter(|(k, n)| found.get(k) == Some(n));
    Share {
        right: right.count(),
        of: truth.len() + only,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_missed_and_counts_invented_are_wrong() {
        let cells = |all: &[(u32, u32)]| -> Cells {
            let one = |&(changes, n)| ((true, 1, changes), BigUint::from(n));
            all.iter().map(one).collect()
        };
        let truth = cells(&[(0, 1), (1, 5), (2, 7)]);
        let share = |found: &[(u32, u32)]| {
            let share = equal_counts(&truth, &cells(found));
            (share.right, share.of)
        };
        assert_eq!(share(&[(0, 1), (1, 5), (2, 7)]), (3, 3));
        assert_eq!(share(&[(0, 1), (1, 6)]), (1, 3));
        assert_eq!(share(&[(0, 1), (1, 5), (2, 7), (3, 2)]), (3, 4));
    }
}
