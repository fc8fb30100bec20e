//! What ways of searching are judged by: a search over a prime that none of them uses, and variants examined one by one.

use super::record::{Share, TrialEffort};
use crate::geom::exact::ExactError;
use crate::model::mechanism::Mechanism;
use crate::rank::exact::field::exact_field;
use crate::score::outcome::Outcome;
use crate::score::request::Request;
use crate::score::run::{RunError, run};
use crate::search::Search;
use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::check::brute::{self, Matrices, Seen};
use crate::search::diagram::Stop;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use itertools::Itertools;
use num_bigint::BigUint;
use num_traits::ToPrimitive;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The prime of the truth, counted from 0: searches use the first two.
const PRIME: usize = 2;

/// Properties of a variant that is judged determinate, and whether it meets every condition.
pub(super) type Judged = (Key, bool);

/// Counts by whether all conditions are asked for, W, and number of changes.
pub(super) type Cells = BTreeMap<(bool, i64, u32), BigUint>;

/// The truth about a mechanism.
pub(super) struct Truth {
    /// The search over the prime of the truth.
    pub(super) search: Search,
    matrices: Matrices,
    /// Variants examined one by one: all, or half of them drawn from all and half from the admissible ones.
    pub(super) looked: Vec<Vec<usize>>,
    /// How many times as many there are.
    pub(super) ratio: f64,
    /// The number of scored variants of a ranking, and whether no other can win.
    pub(super) pool: Option<(usize, bool)>,
    /// How many of the best are asked for.
    pub(super) top: usize,
    judged: Vec<Option<Judged>>,
    cells: Option<Cells>,
    best: Option<Vec<Vec<u64>>>,
}

impl Truth {
    /// Returns the truth about the mechanism and the conditions of an outcome. A ranking is made over the largest pool.
    pub(super) fn new(
        outcome: &Outcome,
        mechanism: &Mechanism,
        request: &Request,
        top: usize,
        effort: TrialEffort,
    ) -> Result<Truth, RunError> {
        let search = search_over_prime(&outcome.search, PRIME)?;
        let matrices = Matrices::new(&search);
        let mut looked = every_or_drawn(&search, effort.looked, request.seed);
        let mut truth = Truth {
            pool: None,
            judged: Vec::new(),
            cells: None,
            best: None,
            looked: Vec::new(),
            ratio: 1.0,
            top,
            matrices,
            search,
        };
        let (search, mut cheapest) = (&truth.search, None);
        if search.size() > BigUint::from(effort.looked) {
            let diagrams = search.build_diagrams(&|| false, &mut |_| {});
            looked.truncate(effort.looked.div_ceil(2));
            let good = search.sample_variants(&diagrams, request.seed);
            looked.extend(good.take(effort.looked / 2).map(|a| a.choices));
            let each = looked.len().max(1) as f64;
            truth.ratio = search.size().to_f64().unwrap_or(f64::INFINITY) / each;
            if diagrams.stop_reason() == Stop::Exhausted {
                let both = [(false, &diagrams.determinate), (true, &diagrams.admissible)];
                let both = both
                    .map(|(all, d)| (all, search.count_variants(d, all).by_mobility_and_changes));
                truth.cells = Some(both.into_iter().flat_map(name_cells).collect());
                cheapest = Some(search.cheapest_variants(&diagrams, top).collect::<Vec<_>>());
            }
        }
        truth.judged = judge_all(&looked, |c| truth.judge_variant(c))?;
        truth.looked = looked;
        if truth.is_whole() {
            truth.cells = Some(truth.cells_of(&truth.judged));
            cheapest = Some(truth.cheapest_judged(&truth.judged));
        }
        truth.best =
            cheapest.map(|list| list.iter().map(|a| truth.sort_properties(a.key)).collect());
        if outcome.ranking.is_some() {
            let request = Request {
                pool: effort.pool,
                ..request.clone()
            };
            let (all, list) = run_and_list(mechanism, &request)?;
            truth.pool = all.ranking.as_ref().map(|r| (r.scored, r.proven));
            // A pool is no judge of itself: outside of it may be better ones.
            let proven = truth.pool.is_some_and(|(_, proven)| proven);
            truth.best = proven.then(|| list.iter().map(choice_key).collect());
        }
        Ok(truth)
    }

    /// Returns whether all variants are examined.
    pub(super) fn is_whole(&self) -> bool {
        self.ratio <= 1.0
    }

    /// Returns the numbers of determinate and of admissible variants.
    pub(super) fn true_counts(&self) -> Option<[BigUint; 2]> {
        let cells = self.cells.as_ref()?;
        let total = |which| {
            let of = cells.iter().filter(|(k, _)| k.0 == which);
            of.map(|(_, n)| n).sum::<BigUint>()
        };
        Some([false, true].map(total))
    }

    fn judge_variant(&self, choices: &[usize]) -> Result<Option<Judged>, ExactError> {
        judge_seen(&self.search, choices, self.matrices.look_at(choices))
    }

    /// Returns how many of all counts, the true ones and those found, are equal.
    pub(super) fn counts_right(&self, found: &Cells) -> Option<Share> {
        Some(equal_counts(self.cells.as_ref()?, found))
    }

    /// Returns how many of the best a list has. Among variants of equal cost, W and number of changes none is better. A variant that
    /// is not admissible in truth is none of the best.
    pub(super) fn best_right(&self, list: &[Assignment]) -> Result<Option<Share>, ExactError> {
        let Some(best) = &self.best else {
            return Ok(None);
        };
        let mut given = Vec::new();
        for a in list {
            given.extend(match self.pool {
                Some(_) => Some(choice_key(a)),
                None => self
                    .judge_variant(&a.choices)?
                    .filter(|j| j.1)
                    .map(|j| self.sort_properties(j.0)),
            });
        }
        let given = given.into_iter().counts();
        let common = |(one, n): (&Vec<u64>, usize)| n.min(given.get(one).copied().unwrap_or(0));
        let right = best.iter().counts().into_iter().map(common).sum();
        let of = best.len();
        Ok(Some(Share { right, of }))
    }

    /// Returns how many of the examined variants are judged rightly: whether determinate, with which σ, and whether admissible.
    pub(super) fn variants_right(&self, judged: &[Option<Judged>]) -> Option<Share> {
        let verdict = |j: &Option<Judged>| j.map(|(key, good)| (key.internal(), good));
        let pairs = self.judged.iter().zip(judged);
        let right = pairs.filter(|(a, b)| verdict(a) == verdict(b)).count();
        let of = self.judged.len();
        Some(Share { right, of })
    }

    /// Returns the counts of judged variants.
    pub(super) fn cells_of(&self, judged: &[Option<Judged>]) -> Cells {
        let mut cells = Cells::new();
        for (key, good) in judged.iter().flatten() {
            for all in [false, true].into_iter().take(1 + usize::from(*good)) {
                let cell = (all, self.search.mobility(*key), key.changes());
                *cells.entry(cell).or_default() += 1u8;
            }
        }
        cells
    }

    /// Returns the cheapest admissible ones of the judged variants, in the order of the program but for ties.
    pub(super) fn cheapest_judged(&self, judged: &[Option<Judged>]) -> Vec<Assignment> {
        let all = self.looked.iter().zip(judged);
        let good = all.filter_map(|(choices, j)| Some((choices, j.filter(|j| j.1)?.0)));
        let sorted = good.sorted_by_key(|(_, key)| self.sort_properties(*key));
        let assignment = |(choices, key): (&Vec<usize>, Key)| Assignment {
            choices: choices.clone(),
            key,
        };
        sorted.take(self.top).map(assignment).collect()
    }

    /// Returns cost, W and number of changes, by which a list is sorted.
    fn sort_properties(&self, key: Key) -> Vec<u64> {
        let w = self.search.mobility(key).unsigned_abs();
        vec![key.cost(), w, u64::from(key.changes())]
    }
}

/// Returns what tells a ranked variant from others.
fn choice_key(a: &Assignment) -> Vec<u64> {
    a.choices.iter().map(|&c| c as u64).collect()
}

/// Returns a search over another prime.
pub(super) fn search_over_prime(search: &Search, nth: usize) -> Result<Search, RunError> {
    let field = exact_field(&search.mechanism, nth)?;
    let conditions = search.conditions.clone();
    Ok(Search::new(field, search.mechanism.clone(), conditions)?)
}

/// Searches by the diagram. Returns the list that was asked for, too.
pub(super) fn run_and_list(
    mechanism: &Mechanism,
    request: &Request,
) -> Result<(Outcome, Vec<Assignment>), RunError> {
    let outcome = run(mechanism.clone(), request, &|| false, &mut |_| {})?;
    let list = outcome.variants().map(|v| v.assignment().clone()).collect();
    Ok((outcome, list))
}

/// Returns the judgement that follows from what was seen of a variant; `None` if it is not determinate.
pub(super) fn judge_seen(
    search: &Search,
    choices: &[usize],
    seen: Seen,
) -> Result<Option<Judged>, ExactError> {
    let judged = brute::judge_variant(search, choices, seen)?;
    Ok(judged.map(|(key, good)| (key, good && search.is_wanted(key))))
}

/// Returns the judgement of a search's diagrams; `None` if the variant is not in that of the determinate ones.
pub(super) fn by_diagram(outcome: &Outcome, choices: &[usize]) -> Option<Judged> {
    let (search, diagrams) = (&outcome.search, outcome.diagrams.as_ref()?);
    let key = |redundancy| brute::variant_key(search, choices, redundancy);
    // The diagram of the determinate ones does not ask what the state makes of a variant.
    match diagrams.admissible.end_of(choices).map(key) {
        Some(key) => Some((key, search.is_wanted(key))),
        None => Some((diagrams.determinate.end_of(choices).map(key)?, false)),
    }
}

/// Judges variants in parallel.
pub(super) fn judge_all<E: Send>(
    variants: &[Vec<usize>],
    judge: impl Fn(&[usize]) -> Result<Option<Judged>, E> + Sync,
) -> Result<Vec<Option<Judged>>, E> {
    variants.par_iter().map(|v| judge(v)).collect()
}

/// Returns the counts of an outcome.
pub(super) fn cells_of_outcome(outcome: &Outcome) -> Cells {
    let both = [(false, &outcome.determinate), (true, &outcome.admissible)];
    let both = both.map(|(all, counts)| (all, counts.by_mobility_and_changes.clone()));
    both.into_iter().flat_map(name_cells).collect()
}

fn name_cells(
    (all, counts): (bool, BTreeMap<(i64, u32), BigUint>),
) -> impl Iterator<Item = ((bool, i64, u32), BigUint)> {
    counts
        .into_iter()
        .map(move |((w, changes), n)| ((all, w, changes), n))
}

/// Returns every variant, or some drawn with equal chance if there are more than `most`.
fn every_or_drawn(search: &Search, most: usize, seed: u64) -> Vec<Vec<usize>> {
    let variables = search.space.variables.iter();
    let radix: Vec<usize> = variables.map(|v| v.choices.len()).collect();
    if search.size() <= BigUint::from(most) {
        let every = radix.iter().map(|&r| 0..r).multi_cartesian_product();
        return every.collect();
    }
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut choice = |r: &usize| usize::try_from(random.next_u64() % *r as u64).unwrap_or(0);
    let mut one = || radix.iter().map(&mut choice).collect();
    (0..most).map(|_| one()).collect()
}

/// Returns how many of all counts, the true ones and those found, are equal.
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
