//! The result of a search by singular values: ranges of counts, and the certain variants.

use super::in_state::Answer;
use super::judge::Judged;
use crate::search::answer::counts::Counts;
use crate::search::answer::estimate::confidence_interval;
use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::diagram::Stop;
use crate::search::question::Question;
use crate::search::question::rounded_rank::Digits;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigUint;
use std::collections::BTreeMap;

/// How many variants meet a condition.
#[derive(Debug, Clone, Default)]
pub struct Bracket {
    /// Those that meet it for sure, so far as ranks at a tolerance are.
    pub sure: Counts,
    /// Those of which the digits do not say, each under the figures it has if it does.
    pub doubtful: Counts,
    /// The maximum: certain and doubtful variants, and those not examined.
    pub most: BigUint,
}

impl Bracket {
    /// Returns true if both ends are the same number.
    #[must_use]
    pub fn is_narrow(&self) -> bool {
        self.sure.total == self.most
    }
}

/// The result of a search by singular values.
#[derive(Debug, Clone)]
pub struct AtTolerance {
    /// The accuracy of the digits.
    pub digits: Digits,
    /// The number of variants examined.
    pub looked: u64,
    /// Those with few enough redundant constraints.
    pub determinate: Bracket,
    /// Those that meet every condition.
    pub admissible: Bracket,
    /// Counts of the sure admissible ones by cost in thousandths.
    pub by_cost: BTreeMap<i64, BigUint>,
    /// The result of a sample, if not all variants were examined.
    pub sampled: Option<Sampled>,
    /// Whether it was ended early.
    pub stop: Stop,
    /// The sure admissible ones, cheapest first.
    pub(super) list: Vec<Assignment>,
}

impl AtTolerance {
    /// Returns true if every variant was examined.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.sampled.is_none() && self.stop == Stop::Exhausted
    }

    /// Returns the certainly admissible variants, cheapest first, then by W, then by changes. If the space was not examined completely,
    /// returns the first of them.
    pub fn list_variants(&self) -> impl Iterator<Item = Assignment> {
        self.list.iter().cloned()
    }

    /// Returns an endless sample of the list, each variant with the same probability. If the space was not examined completely, these are
    /// the cheap variants.
    pub fn draw_variants(&self, seed: u64) -> impl Iterator<Item = Assignment> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let any = move || {
            self.list
                .get(random_index(&mut random, self.list.len()))
                .cloned()
        };
        std::iter::from_fn(any)
    }
}

/// Returns the choices of a variant from its number. The choice of the last variable changes first.
pub(in crate::search) fn choices_of_number(question: &Question, number: u32) -> Vec<usize> {
    let mut rest = number as usize;
    let mut out: Vec<usize> = Vec::with_capacity(question.steps.keys.len());
    for keys in question.steps.keys.iter().rev() {
        out.push(rest % keys.len());
        rest /= keys.len();
    }
    out.reverse();
    out
}

/// How often each kind of variant was met.
#[derive(Debug, Clone, Default)]
pub(super) struct Met {
    pub(super) looked: u64,
    /// Determinate ones: sure, doubtful.
    determinate: [BTreeMap<Key, u64>; 2],
    /// Admissible ones: sure, doubtful.
    admissible: [BTreeMap<Key, u64>; 2],
}

impl Met {
    pub(super) fn add_judged(&mut self, judged: &Judged) {
        self.looked += 1;
        for (answer, [sure, doubtful]) in [
            (judged.determinate, &mut self.determinate),
            (judged.admissible, &mut self.admissible),
        ] {
            match answer {
                Answer::No => {}
                Answer::Yes => *sure.entry(judged.key).or_default() += 1,
                Answer::Perhaps => *doubtful.entry(judged.key).or_default() += 1,
            }
        }
    }

    /// Brackets of the determinate and of the admissible, among `size` variants.
    pub(super) fn count_brackets(&self, question: &Question, size: &BigUint) -> [Bracket; 2] {
        let unseen = size - BigUint::from(self.looked).min(size.clone());
        [&self.determinate, &self.admissible].map(|[sure, doubtful]| {
            let [sure, doubtful] = [sure, doubtful].map(|all| counts_by_key(question, all));
            Bracket {
                most: &sure.total + &doubtful.total + &unseen,
                sure,
                doubtful,
            }
        })
    }

    pub(super) fn by_cost(&self, question: &Question) -> BTreeMap<i64, BigUint> {
        let mut out: BTreeMap<i64, BigUint> = BTreeMap::new();
        for (key, n) in &self.admissible[0] {
            *out.entry(question.steps.cost_in_milli(key.cost()))
                .or_default() += *n;
        }
        out
    }
}

fn counts_by_key(question: &Question, all: &BTreeMap<Key, u64>) -> Counts {
    let mut out = Counts::default();
    for (key, n) in all {
        out.add_variants(question.mobility(*key), *key, &BigUint::from(*n));
    }
    out
}

/// A share of the variants, from a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The share found.
    pub mean: f64,
    /// The lower end of the 95 % confidence interval, without doubtful variants.
    pub low: f64,
    /// and at most this, doubtful ones taken in.
    pub high: f64,
}

impl Share {
    /// Returns the share of those found in a sample, with its exact confidence interval.
    #[allow(clippy::cast_precision_loss, reason = "samples are small")]
    pub(super) fn from_sample(sure: usize, may: usize, of: usize) -> Share {
        Share {
            mean: sure as f64 / of.max(1) as f64,
            low: confidence_interval(of, sure)[0],
            high: confidence_interval(of, may)[1],
        }
    }
}

/// The result of a sample of a space that was not examined completely.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    /// Variants drawn, each with the same chance, with repetition.
    pub drawn: usize,
    /// The seed.
    pub seed: u64,
    /// The determinate variants among them.
    pub determinate: Share,
    /// The admissible ones.
    pub admissible: Share,
    /// The number of variants examined in order of cost.
    pub in_order: usize,
    /// The cost in thousandths below which every variant was examined; `None` if memory does not suffice for the order.
    pub all_below: Option<i64>,
}

/// Returns the choices of a variant drawn at random, all with the same chance.
pub(in crate::search) fn any_choices(question: &Question, random: &mut ChaCha8Rng) -> Vec<usize> {
    let all = question.steps.keys.iter();
    all.map(|keys| random_index(random, keys.len())).collect()
}

/// Returns a number below `n`, each with the same chance.
pub(in crate::search) fn random_index(random: &mut ChaCha8Rng, n: usize) -> usize {
    let n = n.max(1) as u64;
    // What would favour the first numbers is drawn again.
    let fair = u64::MAX - u64::MAX % n;
    loop {
        let x = random.next_u64();
        if x < fair {
            return usize::try_from(x % n).unwrap_or(0);
        }
    }
}
