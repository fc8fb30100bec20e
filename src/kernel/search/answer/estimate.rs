//! About how many variants there are, and no more than how many, where they are not counted: by samples of a larger set that is counted.
//!
//! A diagram with every variant, and some more, gives an upper bound. Each of its paths is drawn with the same probability, and a rank
//! shows whether it is a variant. The share of variants follows the binomial distribution, so the confidence interval also holds for rare
//! variants.
//!
//! # Sources
//! Clopper & Pearson, "The use of confidence or fiducial limits illustrated in the case of the binomial", Biometrika 26 (1934).

use crate::search::answer::by_tally::sample_of;
use crate::search::answer::counts::count_total;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::{Diagram, ShouldCancel, Stop};
use crate::search::question::Question;
use crate::search::solve::at_most::{AtMost, at_most};
use crate::search::solve::orders::Orders;
use crate::search::solve::self_stress::Wanted;
use num_bigint::BigUint;
use num_traits::ToPrimitive;
use rayon::prelude::*;

/// How far the interval of an estimate is to reach on either side, in parts of the mean, where that takes no more than a second or so.
const WITHIN: f64 = 0.01;

/// An estimate of a number of variants.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The mean of what was drawn, whose expected value is the number.
    pub mean: f64,
    /// The standard error of the mean.
    pub standard_error: f64,
    /// The least and the largest number that what was drawn does not contradict, with a confidence of 95 %.
    pub between: [f64; 2],
    /// A certain upper bound, if there is one.
    pub at_most: Option<BigUint>,
    /// The samples.
    pub drawn: Drawn,
    /// The seed of what was drawn.
    pub seed: u64,
}

impl Estimate {
    /// Returns the estimate with its bounds limited: at least `counted`, and no more than `possible`.
    #[must_use]
    pub(in crate::search) fn clamp_to_bounds(
        mut self,
        counted: &BigUint,
        possible: Option<&BigUint>,
    ) -> Self {
        self.at_most = self.at_most.iter().chain(possible).min().cloned();
        let value = |n: &BigUint| n.to_f64().unwrap_or(f64::INFINITY);
        let least = value(counted);
        let most = self
            .at_most
            .as_ref()
            .map_or(f64::INFINITY, value)
            .max(least);
        self.mean = self.mean.clamp(least, most);
        self.between = self.between.map(|x| x.clamp(least, most));
        self
    }
}

/// The samples of an estimate, drawn from a larger set that is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Drawn {
    /// How many samples were drawn.
    pub of: usize,
    /// How many of them are variants that are wanted.
    pub found: usize,
}

/// Samples drawn first, which say how many more are needed.
const PILOT: usize = 1_000;
/// Minimum and maximum number of samples drawn after the pilot.
const SAMPLES: [usize; 2] = [10_000, 200_000];
/// Number of samples between two checks for cancellation.
const BATCH: usize = 500;
/// Standard deviations on either side of the mean that hold a normal variable with a chance of 95 %.
const NORMAL: f64 = 1.96;
/// More than what is needed if the first samples are right, for they are not quite.
const MARGIN: f64 = 1.2;
/// The chance that the number lies above the interval, and that it lies below.
const TAIL: f64 = 0.025;

/// Estimates how many variants of a larger set are wanted, from samples: the first ones say how many more are needed. `filter` also applies
/// the conditions on mobility and changes. Returns `None` if cancelled, if memory does not suffice, or if the set is too large for a
/// floating-point number.
///
/// # Complexity
/// O(samples · n · s²) field operations for n added freedoms and s self-stresses.
fn estimate_count(
    question: &Question,
    of: &AtMost,
    seed: u64,
    filter: bool,
    cancelled: ShouldCancel<'_>,
) -> Option<Estimate> {
    let at_most = count_total(question, &of.diagram, filter);
    let all = at_most.to_f64().filter(|x| x.is_finite())?;
    let mut variants = sample_of(question, &of.diagram, seed, filter);
    // How many were drawn, and how many of them are wanted; none are drawn from an empty set.
    let mut draw = |most: usize| {
        let (mut drawn, mut found) = (0, 0);
        while drawn < most && all > 0.0 {
            let few = BATCH.min(most - drawn);
            let batch: Vec<_> = variants.by_ref().take(few).collect();
            if batch.is_empty() || cancelled() {
                return None;
            }
            drawn += batch.len();
            let wanted = batch.par_iter().filter(|v| of.has_variant(&v.choices));
            found += wanted.count();
        }
        Some((drawn, found))
    };
    let (first, wanted) = draw(PILOT)?;
    // The odds against a sample being wanted.
    let odds = match first {
        0 => 0.0,
        _ => as_float(first - wanted) / as_float(wanted),
    };
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between the least and the most"
    )]
    let needed = ((NORMAL / WITHIN).powi(2) * odds * MARGIN).ceil() as usize;
    let (drawn, found) = draw(needed.clamp(SAMPLES[0], SAMPLES[1]))?;
    let share = as_float(found) / as_float(drawn.max(1));
    let deviation = (share * (1.0 - share) / as_float(drawn.max(1))).sqrt();
    Some(Estimate {
        mean: all * share,
        standard_error: all * deviation,
        between: confidence_interval(drawn, found).map(|x| all * x),
        at_most: Some(at_most),
        drawn: Drawn { of: drawn, found },
        seed,
    })
}

#[allow(clippy::cast_precision_loss, reason = "samples are few")]
fn as_float(of: usize) -> f64 {
    of as f64
}

/// Returns the smallest and the largest probability for which the number found, or a more extreme one, is not rarer than [`TAIL`].
pub(in crate::search) fn confidence_interval(samples: usize, found: usize) -> [f64; 2] {
    let low = match found {
        0 => 0.0,
        _ => bisect_chance(|p| 1.0 - up_to(samples, found - 1, p) < TAIL),
    };
    let high = match samples - found {
        0 => 1.0,
        _ => bisect_chance(|p| up_to(samples, found, p) > TAIL),
    };
    [low, high]
}

/// Returns the point where a test that holds at 0 and not at 1 changes.
fn bisect_chance(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Returns the probability of at most `most` successes in some samples. Each succeeds with probability `p`, which is neither
/// 0 nor 1.
fn up_to(samples: usize, most: usize, p: f64) -> f64 {
    let (n, odds) = (as_float(samples), p.ln() - (-p).ln_1p());
    let mut term = n * (-p).ln_1p();
    let mut sum = term.exp();
    for k in 1..=most {
        let k = as_float(k);
        term += ((n - k + 1.0) / k).ln() + odds;
        sum += term.exp();
    }
    sum
}

/// Returns estimates of the numbers of determinate and of admissible variants if their diagrams are cut. They are made by samples of a
/// larger set that is counted. An entry is `None` if its diagram is whole, if a state is searched, or if redundant constraints are allowed
/// that not all variants have.
pub(in crate::search) fn estimate_counts(
    question: &Question,
    [determinate, admissible]: [&Diagram; 2],
    orders: &Orders,
    limits: &Limits,
    cancelled: ShouldCancel<'_>,
) -> [Option<Estimate>; 2] {
    let seed = match question.conditions.estimate {
        Some(seed) if determinate.stop.combine_with(admissible.stop).is_cut() => seed,
        _ => return [None, None],
    };
    let estimate = |order: &[usize], wanted, diagram: &Diagram, possible: Option<&BigUint>| {
        if !diagram.stop.is_cut() || question.conditions.state.is_some() {
            return None;
        }
        let filter = matches!(wanted, Wanted::Admissible);
        let of = at_most(question, order, limits, wanted, cancelled)?;
        let found = estimate_count(question, &of, seed, filter, cancelled)?;
        Some(found.clamp_to_bounds(&count_total(question, diagram, filter), possible))
    };
    let first = estimate(&orders.determinate, Wanted::Determinate, determinate, None);
    let possible = match &first {
        Some(e) => e.at_most.clone(),
        None => {
            (determinate.stop == Stop::Exhausted).then(|| count_total(question, determinate, false))
        }
    };
    let order = &orders.admissible;
    let second = estimate(order, Wanted::Admissible, admissible, possible.as_ref());
    [first, second]
}

#[cfg(test)]
mod tests {
    use super::confidence_interval;

    /// `scipy.stats.binomtest(k, n).proportion_ci(0.95, "exact")`.
    #[test]
    fn intervals_are_those_of_clopper_and_pearson() {
        let known = [
            (10, 3, [0.066_739_51, 0.652_452_85]),
            (100, 0, [0.0, 0.036_216_69]),
            (100, 100, [0.963_783_31, 1.0]),
            (4000, 3968, [0.988_725_00, 0.994_521_76]),
        ];
        for (samples, found, expected) in known {
            let own = confidence_interval(samples, found);
            for (x, y) in own.iter().zip(expected) {
                assert!((x - y).abs() < 1e-7, "{samples} {found}: {own:?}");
            }
        }
    }
}
