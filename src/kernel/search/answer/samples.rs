//! About how many variants there are, by samples of a larger set that is counted.
//!
//! A diagram with every variant, and some that are none, says how many there are at most. Each of its ways is drawn with the same
//! chance, and its rank says whether it is a variant: the share of those that are follows the binomial distribution, whatever the
//! mechanism, so that its confidence interval holds for rare variants, too.
//!
//! # Sources
//! Clopper & Pearson, "The use of confidence or fiducial limits illustrated in the case of the binomial", Biometrika 26 (1934).

use crate::search::answer::counts::total;
use crate::search::answer::drawn::sample_of;
use crate::search::answer::estimate::{Drawn, Estimate};
use crate::search::build::at_most::AtMost;
use crate::search::question::Question;
use num_traits::ToPrimitive;
use rayon::prelude::*;

/// Samples drawn.
const SAMPLES: usize = 10_000;
/// Samples looked at before it is asked whether all is cancelled.
const BATCH: usize = 500;
/// The chance that the number lies above the interval, and that it lies below.
const TAIL: f64 = 0.025;

/// Estimates how many variants there are among those of a larger set; `filter` applies the conditions on mobility and changes, too.
/// None where it was cancelled, where memory does not suffice, and where the set is too large for a floating-point number.
///
/// # Complexity
/// O(samples · n · s²) field operations for n added freedoms and s self-stresses.
pub(in crate::search) fn estimate(
    question: &Question,
    of: &AtMost,
    seed: u64,
    filter: bool,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Estimate> {
    let at_most = total(question, &of.diagram, filter);
    let all = at_most.to_f64().filter(|x| x.is_finite())?;
    let mut samples = sample_of(question, &of.diagram, seed, filter);
    let (mut drawn, mut found) = (0, 0);
    while drawn < SAMPLES && all > 0.0 {
        let batch: Vec<_> = samples.by_ref().take(BATCH).collect();
        if batch.is_empty() || cancelled() {
            return None;
        }
        drawn += batch.len();
        found += batch.par_iter().filter(|v| of.has(&v.choices)).count();
    }
    #[allow(clippy::cast_precision_loss, reason = "samples are few")]
    let share = found as f64 / drawn.max(1) as f64;
    #[allow(clippy::cast_precision_loss, reason = "samples are few")]
    let deviation = (share * (1.0 - share) / drawn.max(1) as f64).sqrt();
    Some(Estimate {
        mean: all * share,
        standard_error: all * deviation,
        between: interval(drawn, found).map(|x| all * x),
        at_most: Some(at_most),
        drawn: Drawn::Samples { of: drawn, found },
        seed,
    })
}

/// The least and the largest chance at which so many of the samples, or more or fewer of them, are not rarer than [`TAIL`].
fn interval(samples: usize, found: usize) -> [f64; 2] {
    let low = match found {
        0 => 0.0,
        _ => bisected(|p| 1.0 - up_to(samples, found - 1, p) < TAIL),
    };
    let high = match samples - found {
        0 => 1.0,
        _ => bisected(|p| up_to(samples, found, p) > TAIL),
    };
    [low, high]
}

/// Where a test that holds at 0 and not at 1 ends to hold.
fn bisected(holds: impl Fn(f64) -> bool) -> f64 {
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

/// The chance that no more than `most` of some samples are found where each is with the chance `p`, which is neither 0 nor 1.
#[allow(clippy::cast_precision_loss, reason = "samples are few")]
fn up_to(samples: usize, most: usize, p: f64) -> f64 {
    let (n, odds) = (samples as f64, p.ln() - (-p).ln_1p());
    let mut term = n * (-p).ln_1p();
    let mut sum = term.exp();
    for k in 1..=most {
        let k = k as f64;
        term += ((n - k + 1.0) / k).ln() + odds;
        sum += term.exp();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::interval;

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
            let own = interval(samples, found);
            for (x, y) in own.iter().zip(expected) {
                assert!((x - y).abs() < 1e-7, "{samples} {found}: {own:?}");
            }
        }
    }
}
