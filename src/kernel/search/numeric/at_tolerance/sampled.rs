//! Spaces too large to be looked at whole: the cheapest variants in order, and a sample of all.

use super::found::{AtTolerance, BLOCK, Met, Sampled, Share, VariantList, any_choices, order};
use super::judge::{Judge, Judged, Standing};
use crate::search::answer::k_best::Assignment;
use crate::search::diagram::Stop;
use crate::search::numeric::in_order::InOrder;
use crate::search::question::Question;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Variants drawn.
const DRAWN: usize = 20_000;
/// Variants looked at in order of cost, at most.
const IN_ORDER: usize = 20_000;
/// Variants looked at before it is asked whether there are enough of them.
const AT_ONCE: usize = 2048;
/// Of a normal distribution, 95 % is within so many standard deviations.
const NORMAL_95: f64 = 1.959_963_985;

/// Looks for the `wanted` cheapest admissible variants in order, and at a sample.
pub(super) fn search(
    question: &Question,
    judge: &Judge<'_>,
    wanted: usize,
    seed: u64,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> AtTolerance {
    let looking = Looking {
        question,
        judge,
        cancelled,
    };
    let mut met = Met::default();
    let (mut list, next_cost) = looking.in_order(wanted, &mut met);
    let visited = usize::try_from(met.looked).unwrap_or(usize::MAX);
    list.sort_by(|a, b| {
        (order(question, a.key), &a.choices).cmp(&(order(question, b.key), &b.choices))
    });
    let (drawn, [determinate, admissible]) = looking.sample(seed, next_cost, &mut met);
    let sampled = Sampled {
        drawn,
        seed,
        determinate,
        admissible,
        in_order: visited,
        all_below: next_cost.map(|next| question.steps.milli(next)),
    };
    let [determinate, admissible] = met.brackets(question, &question.size());
    AtTolerance {
        digits: judge.digits(),
        looked: met.looked,
        determinate,
        admissible,
        by_cost: Default::default(),
        sampled: Some(sampled),
        stop: if cancelled() {
            Stop::Interrupted
        } else {
            Stop::NodeBudget
        },
        list: VariantList::Variants(list),
    }
}

/// A question whose variants are looked at.
struct Looking<'a> {
    question: &'a Question,
    judge: &'a Judge<'a>,
    cancelled: &'a (dyn Fn() -> bool + Sync),
}

impl Looking<'_> {
    /// Judges variants, those that are come to before it is cancelled.
    fn look(&self, all: Vec<Vec<usize>>) -> Vec<(Vec<usize>, Judged)> {
        let one = |choices: Vec<usize>| {
            (!(self.cancelled)()).then(|| {
                let judged = self.judge.judge(&choices);
                (choices, judged)
            })
        };
        let all = all.into_par_iter().with_min_len(BLOCK).map(one);
        all.collect::<Vec<_>>().into_iter().flatten().collect()
    }

    /// The cost of a variant, in steps.
    fn cost(&self, choices: &[usize]) -> u64 {
        let chosen = self.question.steps.keys.iter().zip(choices);
        chosen.map(|(keys, &c)| keys[c].cost()).sum()
    }

    /// Looks at variants in order of cost until so many are sure to be admissible; gives these, and the cost of the first that was not
    /// looked at.
    fn in_order(&self, wanted: usize, met: &mut Met) -> (Vec<Assignment>, Option<u64>) {
        let mut list: Vec<Assignment> = Vec::new();
        let Some(all) = InOrder::new(&self.question.steps) else {
            return (list, None);
        };
        let mut all = all.peekable();
        while list.len() < wanted && (met.looked as usize) < IN_ORDER && !(self.cancelled)() {
            let block: Vec<Vec<usize>> = all.by_ref().take(AT_ONCE).collect();
            if block.is_empty() {
                break;
            }
            for (choices, judged) in self.look(block) {
                met.add(&judged);
                if let Standing::Sure(key) = judged.admissible {
                    list.push(Assignment { choices, key });
                }
            }
        }
        let next_cost = all.peek().map(|c| self.cost(c));
        (list, next_cost)
    }

    /// Looks at a sample of all: how many were drawn, and the shares of the determinate and the admissible among them. Those that are
    /// dearer than what was looked at in order are met here.
    fn sample(&self, seed: u64, next_cost: Option<u64>, met: &mut Met) -> (usize, [Share; 2]) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let one = |_| any_choices(self.question, &mut random);
        let drawn = self.look((0..DRAWN).map(one).collect());
        let mut seen = BTreeSet::new();
        let mut shares = [[0usize; 2]; 2];
        for (choices, judged) in &drawn {
            for (standing, [sure, may]) in [judged.determinate, judged.admissible]
                .iter()
                .zip(&mut shares)
            {
                *sure += usize::from(matches!(standing, Standing::Sure(_)));
                *may += usize::from(*standing != Standing::No);
            }
            // Those below were counted already.
            if next_cost.is_none_or(|next| self.cost(choices) > next) && seen.insert(choices) {
                met.add(judged);
            }
        }
        let shares = shares.map(|[sure, may]| share(sure, may, drawn.len()));
        (drawn.len(), shares)
    }
}

/// The share of those found in a sample with Wilson's interval (Journal of the American Statistical Association 22, 1927),
/// which holds for small numbers too.
#[allow(clippy::cast_precision_loss, reason = "samples are small")]
fn share(sure: usize, may: usize, of: usize) -> Share {
    let n = of as f64;
    if of == 0 {
        return Share {
            mean: 0.0,
            low: 0.0,
            high: 1.0,
        };
    }
    let z = NORMAL_95;
    let bound = |found: usize, sign: f64| {
        let p = found as f64 / n;
        let spread = (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
        (p + z * z / (2.0 * n) + sign * z * spread) / (1.0 + z * z / n)
    };
    Share {
        mean: sure as f64 / n,
        low: if sure == 0 { 0.0 } else { bound(sure, -1.0) },
        high: if may == of { 1.0 } else { bound(may, 1.0) },
    }
}

#[cfg(test)]
mod tests {
    use super::share;

    #[test]
    fn the_interval_is_wilsons() {
        // Wilson's interval of 10 in 100, worked out by hand: 0.0552 to 0.1744.
        let s = share(10, 10, 100);
        assert!(
            (s.low - 0.0552).abs() < 1e-4 && (s.high - 0.1744).abs() < 1e-4,
            "{s:?}"
        );
        let none = share(0, 0, 20_000);
        assert!(none.low == 0.0 && none.high < 2e-4);
        assert_eq!(share(0, 0, 0).high, 1.0);
    }
}
