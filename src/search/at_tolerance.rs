//! A search by singular values, for mechanisms that exact arithmetic does not have as they are meant.
//!
//! Variants are judged one by one: all of a small space; of a larger one a sample drawn at random, and the cheapest in order.
//! What the digits do not decide is counted as doubtful, so that each count is between those that are sure and these with the
//! doubtful ones. Nothing of it is exact: a rank at a tolerance is likely, not proven.

mod in_state;
mod judge;
mod sampled;

pub use sampled::{Sampled, Share};

use crate::geom::exact::ExactError;
use crate::search::best::Assignment;
use crate::search::conditions::Search;
use crate::search::counts::Counts;
use crate::search::diagram::Stop;
use crate::search::doubt::{Digits, RankRange};
use crate::search::tally::Key;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use judge::{Judge, Judged, Standing};
use num_bigint::BigUint;
use num_traits::ToPrimitive;
use rayon::prelude::*;
pub(super) use sampled::below;
use std::collections::BTreeMap;

/// Spaces of no more variants than this are looked at whole.
pub const WHOLE: u32 = 300_000;
/// Variants that are looked at by one thread before it asks whether to end.
const BLOCK: usize = 64;

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
    /// The rank of the mechanism as it is.
    pub present: RankRange,
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
    list: List,
}

/// Variants in few bytes.
#[derive(Debug, Clone)]
enum List {
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
    pub fn list<'a>(&'a self, search: &'a Search) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        match &self.list {
            List::Numbers(all) => Box::new(all.iter().map(|&(key, number)| Assignment {
                choices: choices(search, number),
                key,
            })),
            List::Variants(all) => Box::new(all.iter().cloned()),
        }
    }

    /// Variants of the list drawn at random without end, each with the same chance; of a space not looked at whole those
    /// are the cheap ones.
    pub fn drawn<'a>(
        &'a self,
        search: &'a Search,
        seed: u64,
    ) -> impl Iterator<Item = Assignment> + 'a {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        std::iter::from_fn(move || match &self.list {
            List::Numbers(all) if !all.is_empty() => {
                let (key, number) = all[below(&mut random, all.len())];
                Some(Assignment {
                    choices: choices(search, number),
                    key,
                })
            }
            List::Variants(all) if !all.is_empty() => {
                Some(all[below(&mut random, all.len())].clone())
            }
            _ => None,
        })
    }
}

/// The choices of a variant from its number: the last variable's change first.
pub(super) fn choices(search: &Search, number: u32) -> Vec<usize> {
    let mut rest = number as usize;
    let mut out: Vec<usize> = Vec::with_capacity(search.steps.keys.len());
    for keys in search.steps.keys.iter().rev() {
        out.push(rest % keys.len());
        rest /= keys.len();
    }
    out.reverse();
    out
}

/// How often each kind of variant was met.
#[derive(Debug, Clone, Default)]
struct Met {
    looked: u64,
    /// Determinate ones: sure, doubtful.
    determinate: [BTreeMap<Key, u64>; 2],
    /// Admissible ones: sure, doubtful.
    admissible: [BTreeMap<Key, u64>; 2],
}

impl Met {
    fn add(&mut self, judged: &Judged) {
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

    fn merge(&mut self, other: Met) {
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
    fn brackets(&self, search: &Search, size: &BigUint) -> [Bracket; 2] {
        let unseen = size - BigUint::from(self.looked).min(size.clone());
        [&self.determinate, &self.admissible].map(|[sure, doubtful]| {
            let [sure, doubtful] = [sure, doubtful].map(|all| counts(search, all));
            Bracket {
                most: &sure.total + &doubtful.total + &unseen,
                sure,
                doubtful,
            }
        })
    }

    fn by_cost(&self, search: &Search) -> BTreeMap<i64, BigUint> {
        let mut out: BTreeMap<i64, BigUint> = BTreeMap::new();
        for (key, n) in &self.admissible[0] {
            *out.entry(search.steps.milli(key.cost())).or_default() += *n;
        }
        out
    }
}

fn counts(search: &Search, all: &BTreeMap<Key, u64>) -> Counts {
    let mut out = Counts::default();
    for (key, n) in all {
        out.add(search.mobility(*key), *key, &BigUint::from(*n));
    }
    out
}

/// The order of lists: cheapest first, then by W, then by changes.
fn order(search: &Search, key: Key) -> (u64, i64, u32, Key) {
    (key.cost(), search.mobility(key), key.changes(), key)
}

impl Search {
    /// Searches by singular values. Of spaces too large to be looked at whole `list` of the cheapest are looked for, and a
    /// sample is drawn from `seed`.
    ///
    /// # Errors
    /// Where a coordinate has no value.
    ///
    /// # Complexity
    /// Two or three decompositions of a matrix of 6k rows a variant, in parallel, [`WHOLE`] variants at most; memory is some
    /// 20 bytes for each admissible one.
    pub fn at_tolerance(
        &mut self,
        digits: Digits,
        (list, seed): (usize, u64),
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<AtTolerance, ExactError> {
        let judge = Judge::new(self, digits)?;
        let present = judge.present();
        let size = self.size();
        let found = match size.to_u32().filter(|n| *n <= WHOLE) {
            Some(n) => self.whole(&judge, n, cancelled),
            None => sampled::search(self, &judge, (list, seed), cancelled),
        };
        let motion = judge.motion();
        drop(judge);
        self.present = Some(motion);
        Ok(AtTolerance {
            digits,
            present,
            ..found
        })
    }

    fn whole(
        &self,
        judge: &Judge<'_>,
        size: u32,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> AtTolerance {
        let blocks = (size as usize).div_ceil(BLOCK);
        let block = |b: usize| {
            let (mut met, mut list) = (Met::default(), Vec::new());
            let to = ((b + 1) * BLOCK).min(size as usize);
            for number in (b * BLOCK..to).filter_map(|n| u32::try_from(n).ok()) {
                if cancelled() {
                    break;
                }
                let judged = judge.judge(&choices(self, number));
                if let Standing::Sure(key) = judged.admissible {
                    list.push((key, number));
                }
                met.add(&judged);
            }
            (met, list)
        };
        let together = |(mut met, mut list): (Met, Vec<_>), (more, others): (Met, Vec<_>)| {
            met.merge(more);
            list.extend(others);
            (met, list)
        };
        let all = (0..blocks).into_par_iter().map(block);
        let (met, mut list): (Met, Vec<(Key, u32)>) = all.reduce(Default::default, together);
        list.sort_unstable_by_key(|&(key, n)| (order(self, key), n));
        let [determinate, admissible] = met.brackets(self, &size.into());
        AtTolerance {
            digits: judge.digits(),
            present: judge.present(),
            looked: met.looked,
            determinate,
            admissible,
            by_cost: met.by_cost(self),
            sampled: None,
            stop: if met.looked == u64::from(size) {
                Stop::Exhausted
            } else {
                Stop::Interrupted
            },
            list: List::Numbers(list),
        }
    }
}
