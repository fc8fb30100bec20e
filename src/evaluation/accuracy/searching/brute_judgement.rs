//! Variants looked at one by one, and what follows for counts and for the best of them.

use crate::geom::exact::ExactError;
use crate::score::outcome::Outcome;
use crate::search::Search;
use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::check::brute;
use crate::search::check::brute::Seen;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigUint;
use num_traits::ToPrimitive;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What a way says of one variant that it takes for determinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct JudgedVariant {
    /// Its properties.
    pub(super) key: Key,
    /// Whether it meets every condition.
    pub(super) admissible: bool,
}

/// Counts by whether all conditions are asked for, W, and number of changes.
pub(super) type Cells = BTreeMap<(bool, i64, u32), BigUint>;

/// Cost, W and number of changes: what the order of a list goes by.
pub(super) type Properties = (u64, i64, u32);

/// The judgement that follows from what was seen of a variant; `None` where it is not determinate.
pub(super) fn judged(
    search: &Search,
    choices: &[usize],
    seen: Seen,
) -> Result<Option<JudgedVariant>, ExactError> {
    let judged = brute::judge(search, choices, seen)?;
    Ok(judged.map(|(key, good)| JudgedVariant {
        key,
        admissible: good && search.wanted(key),
    }))
}

/// The judgement of a search's diagrams; `None` where the variant is not in that of the determinate ones.
pub(super) fn by_diagram(outcome: &Outcome, choices: &[usize]) -> Option<JudgedVariant> {
    let (search, diagrams) = (&outcome.search, outcome.diagrams.as_ref()?);
    let key = |redundancy| brute::key(search, choices, redundancy);
    let admissible = diagrams.admissible.end(choices).map(key);
    let key = match admissible {
        // The determinate ones' diagram does not ask what the state makes of a variant.
        Some(key) => key,
        None => diagrams.determinate.end(choices).map(key)?,
    };
    let admissible = admissible.is_some_and(|k| search.wanted(k));
    Some(JudgedVariant { key, admissible })
}

/// Judges variants in parallel.
pub(super) fn judge_all<E: Send>(
    variants: &[Vec<usize>],
    judge: impl Fn(&[usize]) -> Result<Option<JudgedVariant>, E> + Sync,
) -> Result<Vec<Option<JudgedVariant>>, E> {
    variants.par_iter().map(|v| judge(v)).collect()
}

/// Every choice of some variables by how many each has, those of the first changing fastest; `None` where there are more than
/// `most`.
fn through(radix: &[usize], most: usize) -> Option<Vec<Vec<usize>>> {
    let all: BigUint = radix.iter().map(|&r| BigUint::from(r)).product();
    let all = all.to_usize().filter(|n| *n <= most)?;
    let one = |mut n: usize| {
        let digit = |r: &usize| {
            let choice = n % r;
            n /= r;
            choice
        };
        radix.iter().map(digit).collect()
    };
    Some((0..all).map(one).collect())
}

/// Choices of some variables drawn at random, each with the same chance.
fn at_random(radix: &[usize], count: usize, seed: u64) -> Vec<Vec<usize>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut choice = |r: &usize| usize::try_from(random.next_u64() % *r as u64).unwrap_or(0);
    let mut one = || radix.iter().map(&mut choice).collect();
    (0..count).map(|_| one()).collect()
}

/// How many choices each variable of a space has.
fn radix(search: &Search) -> Vec<usize> {
    let variables = search.space.variables.iter();
    variables.map(|v| v.choices.len()).collect()
}

/// Every variant of a space; `None` where there are more than `most`.
pub(super) fn every(search: &Search, most: usize) -> Option<Vec<Vec<usize>>> {
    through(&radix(search), most)
}

/// Variants drawn at random, each with the same chance.
pub(super) fn drawn(search: &Search, count: usize, seed: u64) -> Vec<Vec<usize>> {
    at_random(&radix(search), count, seed)
}

/// Beginnings of variants in an order of their variables, and how many there are: all, or some drawn at random, with no more
/// variants below them together than `most`.
pub(super) fn beginnings(
    search: &Search,
    order: &[usize],
    most: usize,
) -> (Vec<Vec<usize>>, BigUint) {
    /// Of a large space so many branches are looked at.
    const SOME: usize = 64;
    let all = radix(search);
    let mut begun: Vec<usize> = order.iter().map(|&v| all[v]).collect();
    let mut below = 1;
    while let Some(last) = begun.pop_if(|last| below * *last * SOME <= most) {
        below *= last;
    }
    let of = begun.iter().map(|&r| BigUint::from(r)).product();
    let some = through(&begun, most / below)
        .unwrap_or_else(|| at_random(&begun, (most / below).max(1), 1));
    (some, of)
}

/// How many times as many variants a space has as were looked at.
pub(super) fn ratio(size: &BigUint, looked: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    let looked = looked.max(1) as f64;
    size.to_f64().unwrap_or(f64::INFINITY) / looked
}

/// Counts of judged variants.
pub(super) fn cells(search: &Search, judged: &[Option<JudgedVariant>]) -> Cells {
    let mut cells = Cells::new();
    for j in judged.iter().flatten() {
        let (w, changes) = (search.mobility(j.key), j.key.changes());
        *cells.entry((false, w, changes)).or_default() += 1u8;
        if j.admissible {
            *cells.entry((true, w, changes)).or_default() += 1u8;
        }
    }
    cells
}

/// Counts of an outcome.
pub(super) fn cells_of_counts(outcome: &Outcome) -> Cells {
    let both = [(false, &outcome.determinate), (true, &outcome.admissible)];
    let all = both.into_iter().flat_map(|(all, counts)| {
        let cells = counts.by_mobility_and_changes.iter();
        cells.map(move |(&(w, c), n)| ((all, w, c), n.clone()))
    });
    all.collect()
}

pub(super) fn properties(search: &Search, key: Key) -> Properties {
    (key.cost(), search.mobility(key), key.changes())
}

/// The cheapest admissible ones of judged variants, as the program orders them but for ties.
pub(super) fn cheapest(
    search: &Search,
    variants: &[Vec<usize>],
    judged: &[Option<JudgedVariant>],
    top: usize,
) -> Vec<Assignment> {
    let admissible = variants.iter().zip(judged).filter_map(|(choices, j)| {
        let key = j.filter(|j| j.admissible)?.key;
        Some((properties(search, key), choices, key))
    });
    let mut all: Vec<_> = admissible.collect();
    all.sort_by_key(|(p, ..)| *p);
    let assignment = |(_, choices, key): (Properties, &Vec<usize>, Key)| Assignment {
        choices: choices.clone(),
        key,
    };
    all.into_iter().take(top).map(assignment).collect()
}
