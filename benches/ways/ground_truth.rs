//! What ways of searching are judged by: a search over a prime that none of them uses, and variants examined one by one.

use super::record::{Share, TrialEffort};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use itertools::Itertools;
use num_bigint::BigUint;
use num_traits::ToPrimitive;
use ozols::geom::exact::ExactError;
use ozols::model::mechanism::Mechanism;
use ozols::rank::exact::field::exact_field;
use ozols::score::outcome::Outcome;
use ozols::score::request::Request;
use ozols::score::run::{RunError, run};
use ozols::search::Search;
use ozols::search::answer::keys::Key;
use ozols::search::check::brute::{self, Matrices, Seen};
use ozols::search::diagram::{Control, Stop};
use rayon::prelude::*;

/// The prime of the truth, counted from 0: searches use the first two.
const PRIME: usize = 2;

/// Properties of a variant that is judged determinate, and whether it meets every condition.
pub(crate) type Judged = (Key, bool);

/// The numbers of determinate and of admissible variants.
pub(crate) type Counts = [BigUint; 2];

/// The truth about a mechanism.
pub(crate) struct Truth {
    /// The search over the prime of the truth.
    pub(crate) search: Search,
    matrices: Matrices,
    /// Variants examined one by one: all, or half of them drawn from all and half from the admissible ones.
    pub(crate) looked: Vec<Vec<usize>>,
    /// How many times as many there are.
    pub(crate) ratio: f64,
    /// The number of scored variants of a ranking, and whether no other can win.
    pub(crate) pool: Option<(usize, bool)>,
    judged: Vec<Option<Judged>>,
    /// `None` if the diagram over the prime of the truth does not fit into the budget.
    pub(crate) counts: Option<Counts>,
    /// The choices of the best in a ranking; `None` if there is none, or others may win.
    best: Option<Vec<Vec<usize>>>,
}

impl Truth {
    /// Returns the truth about the mechanism and the conditions of an outcome. A ranking is made over the largest pool.
    pub(crate) fn new(
        outcome: &Outcome,
        mechanism: &Mechanism,
        request: &Request,
        effort: TrialEffort,
    ) -> Result<Truth, RunError> {
        let search = search_over_prime(&outcome.search, PRIME)?;
        let matrices = Matrices::new(&search);
        let mut looked = every_or_drawn(&search, effort.looked, request.seed);
        let mut truth = Truth {
            pool: None,
            judged: Vec::new(),
            counts: None,
            best: None,
            looked: Vec::new(),
            ratio: 1.0,
            matrices,
            search,
        };
        let search = &truth.search;
        if search.size() > BigUint::from(effort.looked) {
            let diagrams = search.build_diagrams(Control::NONE);
            looked.truncate(effort.looked.div_ceil(2));
            let good = search.sample_variants(&diagrams, request.seed);
            looked.extend(good.take(effort.looked / 2).map(|a| a.choices));
            let each = looked.len().max(1) as f64;
            truth.ratio = search.size().to_f64().unwrap_or(f64::INFINITY) / each;
            if diagrams.stop_reason() == Stop::Exhausted {
                let both = [(false, &diagrams.determinate), (true, &diagrams.admissible)];
                truth.counts = Some(both.map(|(all, d)| search.count_variants(d, all).total));
            }
        }
        truth.judged = judge_all(&looked, |c| truth.judge_variant(c))?;
        truth.looked = looked;
        if truth.is_whole() {
            truth.counts = Some(count_judged(&truth.judged));
        }
        if outcome.ranking.is_some() {
            let request = Request {
                pool: effort.pool,
                ..request.clone()
            };
            let all = search_with(mechanism, &request)?;
            truth.pool = all.ranking.as_ref().map(|r| (r.scored, r.proven));
            // A pool is no judge of itself: outside of it may be better ones.
            let proven = truth.pool.is_some_and(|(_, proven)| proven);
            truth.best = proven.then(|| choices_listed(&all));
        }
        Ok(truth)
    }

    /// Returns whether all variants are examined.
    pub(crate) fn is_whole(&self) -> bool {
        self.ratio <= 1.0
    }

    fn judge_variant(&self, choices: &[usize]) -> Result<Option<Judged>, ExactError> {
        judge_seen(&self.search, choices, self.matrices.look_at(choices))
    }

    /// Returns how many of the two counts are right.
    pub(crate) fn counts_right(&self, found: &Counts) -> Option<Share> {
        let pairs = self.counts.as_ref()?.iter().zip(found);
        let right = pairs.filter(|(a, b)| a == b).count();
        Some(Share { right, of: 2 })
    }

    /// Returns how many of the best of a ranking an outcome lists.
    pub(crate) fn best_right(&self, outcome: &Outcome) -> Option<Share> {
        let (best, given) = (self.best.as_ref()?, choices_listed(outcome));
        let right = best.iter().filter(|b| given.contains(b)).count();
        let of = best.len();
        Some(Share { right, of })
    }

    /// Returns how many of the examined variants are judged rightly: whether determinate, with which σ, and whether admissible.
    pub(crate) fn variants_right(&self, judged: &[Option<Judged>]) -> Share {
        let verdict = |j: &Option<Judged>| j.map(|(key, good)| (key.internal(), good));
        let pairs = self.judged.iter().zip(judged);
        let right = pairs.filter(|(a, b)| verdict(a) == verdict(b)).count();
        let of = self.judged.len();
        Share { right, of }
    }
}

/// Returns the counts of judged variants.
pub(crate) fn count_judged(judged: &[Option<Judged>]) -> Counts {
    let determinate = judged.iter().flatten();
    [
        determinate.clone().count(),
        determinate.filter(|j| j.1).count(),
    ]
    .map(BigUint::from)
}

/// Returns the choices of each variant that an outcome lists.
fn choices_listed(outcome: &Outcome) -> Vec<Vec<usize>> {
    let listed = outcome.variants();
    listed.map(|v| v.assignment().choices.clone()).collect()
}

/// Returns a search over another prime.
pub(crate) fn search_over_prime(search: &Search, nth: usize) -> Result<Search, RunError> {
    let field = exact_field(&search.mechanism, nth)?;
    let conditions = search.conditions.clone();
    Ok(Search::new(field, search.mechanism.clone(), conditions)?)
}

/// Searches by the diagram.
pub(crate) fn search_with(mechanism: &Mechanism, request: &Request) -> Result<Outcome, RunError> {
    run(mechanism.clone(), request, &|| false, &mut |_| {})
}

/// Returns the judgement that follows from what was seen of a variant; `None` if it is not determinate.
pub(crate) fn judge_seen(
    search: &Search,
    choices: &[usize],
    seen: Seen,
) -> Result<Option<Judged>, ExactError> {
    let judged = brute::judge_variant(search, choices, seen)?;
    Ok(judged.map(|(key, good)| (key, good && search.is_wanted(key))))
}

/// Returns the judgement of a search's diagrams; `None` if the variant is not in that of the determinate ones.
pub(crate) fn by_diagram(outcome: &Outcome, choices: &[usize]) -> Option<Judged> {
    let (search, diagrams) = (&outcome.search, outcome.diagrams.as_ref()?);
    let key = |redundancy| search.steps.variant_key(choices, redundancy);
    // The diagram of the determinate ones does not ask what the state makes of a variant.
    match diagrams.admissible.end_of(choices).map(key) {
        Some(key) => Some((key, search.is_wanted(key))),
        None => Some((diagrams.determinate.end_of(choices).map(key)?, false)),
    }
}

/// Judges variants in parallel.
pub(crate) fn judge_all<E: Send>(
    variants: &[Vec<usize>],
    judge: impl Fn(&[usize]) -> Result<Option<Judged>, E> + Sync,
) -> Result<Vec<Option<Judged>>, E> {
    variants.par_iter().map(|v| judge(v)).collect()
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
