//! Spaces too large to be looked at whole: the cheapest variants in order, and a sample of all.

use super::found::{AtTolerance, BLOCK, Met, Sampled, Share, VariantList, below, order};
use super::judge::{Judge, Standing};
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
    let mut met = Met::default();
    let mut list: Vec<Assignment> = Vec::new();
    let look = |all: Vec<Vec<usize>>| -> Vec<_> {
        let one = |choices: Vec<usize>| {
            (!cancelled()).then(|| {
                let judged = judge.judge(&choices);
                (choices, judged)
            })
        };
        let all = all.into_par_iter().with_min_len(BLOCK).map(one);
        all.collect::<Vec<_>>().into_iter().flatten().collect()
    };
    let cost = |choices: &[usize]| {
        let chosen = question.steps.keys.iter().zip(choices);
        chosen.map(|(keys, &c)| keys[c].cost()).sum::<u64>()
    };
    // The cost of the first variant not looked at.
    let mut next_cost = None;
    if let Some(all) = InOrder::new(&question.steps) {
        let mut all = all.peekable();
        while list.len() < wanted && (met.looked as usize) < IN_ORDER && !cancelled() {
            let block: Vec<Vec<usize>> = all.by_ref().take(AT_ONCE).collect();
            if block.is_empty() {
                break;
            }
            for (choices, judged) in look(block) {
                met.add(&judged);
                if let Standing::Sure(key) = judged.admissible {
                    list.push(Assignment { choices, key });
                }
            }
        }
        next_cost = all.peek().map(|c| cost(c));
    }
    let visited = usize::try_from(met.looked).unwrap_or(usize::MAX);
    list.sort_by(|a, b| {
        (order(question, a.key), &a.choices).cmp(&(order(question, b.key), &b.choices))
    });
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let radix: Vec<usize> = question.steps.keys.iter().map(Vec::len).collect();
    let mut one = || -> Vec<usize> { radix.iter().map(|&n| below(&mut random, n)).collect() };
    let drawn = look((0..DRAWN).map(|_| one()).collect());
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
        if next_cost.is_none_or(|next| cost(choices) > next) && seen.insert(choices) {
            met.add(judged);
        }
    }
    let [determinate, admissible] = shares.map(|[sure, may]| share(sure, may, drawn.len()));
    let sampled = Sampled {
        drawn: drawn.len(),
        seed,
        determinate,
        admissible,
        in_order: visited,
        all_below: next_cost.map(|next| question.steps.milli(next)),
    };
    let [determinate, admissible] = met.brackets(question, &question.size());
    AtTolerance {
        digits: judge.digits(),
        present: judge.present(),
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
