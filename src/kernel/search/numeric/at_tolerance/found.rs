//! What a search by singular values found: brackets of counts, and the sure variants in few bytes.

use super::judge::{Judged, Standing};
use crate::search::answer::counts::Counts;
use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::diagram::Stop;
use crate::search::question::Question;
use crate::search::question::rounded_rank::Digits;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigUint;
use std::collections::BTreeMap;

/// Variants that are looked at by one thread before it asks whether to end.
pub(super) const BLOCK: usize = 64;

/// How many variants meet a condition.
#[derive(Debug, Clone, Default)]
pub struct Bracket {
    /// Those that meet it for sure, so far as ranks at a tolerance are.
    pub sure: Counts,
    /// Those of which the digits do not say, each under the figures it has if it does.
    pub doubtful: Counts,
    /// The most there can be: the sure and the doubtful ones, and those not looked at.
    pub most: BigUint,
}

impl Bracket {
    /// Whether from and to are one number.
    #[must_use]
    pub fn is_narrow(&self) -> bool {
        self.sure.total == self.most
    }
}

/// What was found by singular values.
#[derive(Debug, Clone)]
pub struct AtTolerance {
    /// What the digits tell.
    pub digits: Digits,
    /// How many variants were looked at.
    pub looked: u64,
    /// Those with few enough redundant constraints.
    pub determinate: Bracket,
    /// Those that meet every condition.
    pub admissible: Bracket,
    /// Counts of the sure admissible ones by cost in thousandths.
    pub by_cost: BTreeMap<i64, BigUint>,
    /// What a sample says, where not all were looked at.
    pub sampled: Option<Sampled>,
    /// Whether it was ended early.
    pub stop: Stop,
    /// The sure admissible ones, cheapest first.
    pub(super) list: VariantList,
}

/// Variants in few bytes.
#[derive(Debug, Clone)]
pub(super) enum VariantList {
    /// By number, where every variant has one.
    Numbers(Vec<(Key, u32)>),
    Variants(Vec<Assignment>),
}

impl AtTolerance {
    /// Whether every variant was looked at.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.sampled.is_none() && self.stop == Stop::Exhausted
    }

    /// The sure admissible variants, cheapest first, then by W, then by changes; of a space not looked at whole the first of
    /// them.
    pub fn list<'a>(&'a self, question: &'a Question) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        match &self.list {
            VariantList::Numbers(all) => Box::new(all.iter().map(|&(key, number)| Assignment {
                choices: choices(question, number),
                key,
            })),
            VariantList::Variants(all) => Box::new(all.iter().cloned()),
        }
    }

    /// Variants of the list drawn at random without end, each with the same chance; of a space not looked at whole those
    /// are the cheap ones.
    pub fn drawn<'a>(
        &'a self,
        question: &'a Question,
        seed: u64,
    ) -> impl Iterator<Item = Assignment> + 'a {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        std::iter::from_fn(move || match &self.list {
            VariantList::Numbers(all) if !all.is_empty() => {
                let (key, number) = all[below(&mut random, all.len())];
                Some(Assignment {
                    choices: choices(question, number),
                    key,
                })
            }
            VariantList::Variants(all) if !all.is_empty() => {
                Some(all[below(&mut random, all.len())].clone())
            }
            _ => None,
        })
    }
}

/// The choices of a variant from its number: the last variable's change first.
pub(in crate::search) fn choices(question: &Question, number: u32) -> Vec<usize> {
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
    pub(super) fn add(&mut self, judged: &Judged) {
        self.looked += 1;
        for (standing, counts) in [
            (&judged.determinate, &mut self.determinate),
            (&judged.admissible, &mut self.admissible),
        ] {
            let [sure, doubtful] = counts;
            match standing {
                Standing::No => {}
                Standing::Sure(key) => *sure.entry(*key).or_default() += 1,
                Standing::Doubtful(key) => *doubtful.entry(*key).or_default() += 1,
            }
        }
    }

    pub(super) fn merge(&mut self, other: Met) {
        self.looked += other.looked;
        let theirs = other.determinate.into_iter().chain(other.admissible);
        let ours = self.determinate.iter_mut().chain(&mut self.admissible);
        for (own, other) in ours.zip(theirs) {
            for (key, n) in other {
                *own.entry(key).or_default() += n;
            }
        }
    }

    /// Brackets of the determinate and of the admissible, among `size` variants.
    pub(super) fn brackets(&self, question: &Question, size: &BigUint) -> [Bracket; 2] {
        let unseen = size - BigUint::from(self.looked).min(size.clone());
        [&self.determinate, &self.admissible].map(|[sure, doubtful]| {
            let [sure, doubtful] = [sure, doubtful].map(|all| counts(question, all));
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
            *out.entry(question.steps.milli(key.cost())).or_default() += *n;
        }
        out
    }
}

fn counts(question: &Question, all: &BTreeMap<Key, u64>) -> Counts {
    let mut out = Counts::default();
    for (key, n) in all {
        out.add(question.mobility(*key), *key, &BigUint::from(*n));
    }
    out
}

/// The order of lists: cheapest first, then by W, then by changes.
pub(super) fn order(question: &Question, key: Key) -> (u64, i64, u32, Key) {
    (key.cost(), question.mobility(key), key.changes(), key)
}

/// A share of the variants, from a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The share found.
    pub mean: f64,
    /// In 95 of 100 samples the true share is at least this, doubtful variants left out,
    pub low: f64,
    /// and at most this, doubtful ones taken in.
    pub high: f64,
}

/// What a sample says of a space that was not looked at whole.
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
    /// Variants looked at in order of cost.
    pub in_order: usize,
    /// The cost in thousandths below which every variant was looked at; none where costs cannot be told apart so finely.
    pub all_below: Option<i64>,
}

/// The choices of a variant drawn at random, each with the same chance.
pub(in crate::search) fn any_choices(question: &Question, random: &mut ChaCha8Rng) -> Vec<usize> {
    let all = question.steps.keys.iter();
    all.map(|keys| below(random, keys.len())).collect()
}

/// A number below `n`, each with the same chance.
pub(in crate::search) fn below(random: &mut ChaCha8Rng, n: usize) -> usize {
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
