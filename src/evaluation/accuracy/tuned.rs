//! Every floating-point method at the tolerance at which it is right most often.

use super::AnswerVerdict;
use super::cases::Case;
use crate::closure::Closure;
use crate::geom::Reals;
use crate::rank::method::registry;
use crate::rank::method::{Answer, Certainty, NoAnswer, Quantity};
use crate::rank::numeric::Elimination;
use rayon::prelude::*;

/// A floating-point method at its best tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuned {
    /// Its place in [`registry::ALL`].
    pub method: usize,
    /// The tolerance: the middle, on a log scale, of the longest stretch of the best.
    pub tolerance: f64,
    /// Cases in which it then gives the finite mobility.
    pub right: usize,
    /// Cases in which it then gives the mobility at the pose, which is not the finite one.
    pub pose: usize,
    /// The tolerance it has when nobody says otherwise.
    pub default: f64,
    /// Cases in which it gives the finite mobility at that.
    pub right_by_default: usize,
}

/// Tolerances from 1e-15 to 1e-3 by half decades, or every `step`th of them.
#[must_use]
pub fn tolerances(step: usize) -> Vec<f64> {
    let halves = (-30..=-6).step_by(step);
    halves
        .map(|half| 10f64.powf(f64::from(half) / 2.0))
        .collect()
}

/// How often each tolerance gives the finite mobility, and the mobility at the pose alone.
fn tally(cases: &[Case], of: Elimination, tolerances: &[f64]) -> Vec<[usize; 2]> {
    let verdicts = |case: &Case| -> Vec<AnswerVerdict> {
        let Ok(closure) = Closure::new(&Reals, &case.mechanism, case.state) else {
            return vec![AnswerVerdict::Failed; tolerances.len()];
        };
        let found = of.mobilities(&closure, tolerances).into_iter();
        let verdict = |w: Option<i64>| {
            let answer = w.ok_or_else(|| NoAnswer::Failed(String::new()));
            let answer = answer.map(|mobility| Answer {
                mobility,
                quantity: Quantity::Instantaneous,
                certainty: Certainty::Counted,
            });
            AnswerVerdict::on(&answer, case.truth)
        };
        found.map(verdict).collect()
    };
    let all: Vec<Vec<AnswerVerdict>> = cases.par_iter().map(verdicts).collect();
    let count = |t: usize, of: fn(AnswerVerdict) -> bool| all.iter().filter(|v| of(v[t])).count();
    let at = |t| {
        [
            count(t, |v| v == AnswerVerdict::Right),
            count(t, |v| matches!(v, AnswerVerdict::Pose(_))),
        ]
    };
    (0..tolerances.len()).map(at).collect()
}

/// Returns the first and the last number of the longest run of good numbers below `count`. Of equally long runs it is the first one.
pub(super) fn longest_run(count: usize, good: impl Fn(usize) -> bool) -> Option<(usize, usize)> {
    let (mut best, mut begun) = (None::<(usize, usize)>, None);
    for n in 0..count {
        if !good(n) {
            begun = None;
            continue;
        }
        let from = *begun.get_or_insert(n);
        if best.is_none_or(|(first, last)| n - from > last - first) {
            best = Some((from, n));
        }
    }
    best
}

/// The middle of the longest stretch of the largest numbers.
fn middle_of_best(numbers: &[usize]) -> usize {
    let best = numbers.iter().max();
    let run = longest_run(numbers.len(), |n| Some(&numbers[n]) == best);
    run.map_or(0, |(first, last)| (first + last) / 2)
}

/// Every floating-point method at its best tolerance; the default one where no other is better.
#[must_use]
pub(crate) fn tuned(cases: &[Case]) -> Vec<Tuned> {
    let methods = registry::ALL.iter().enumerate();
    let floats = methods.filter_map(|(n, m)| Some((n, Elimination::of(*m)?)));
    floats
        .map(|(method, of)| {
            let default = of.default_tolerance();
            let mut tried = tolerances(1);
            tried.push(default);
            let found = tally(cases, of, &tried);
            let last = tried.len() - 1;
            let right: Vec<usize> = found[..last].iter().map(|f| f[0]).collect();
            let best = match right.iter().max() {
                Some(&most) if most > found[last][0] => middle_of_best(&right),
                _ => last,
            };
            Tuned {
                method,
                tolerance: tried[best],
                right: found[best][0],
                pose: found[best][1],
                default,
                right_by_default: found[last][0],
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::middle_of_best;

    #[test]
    fn the_longest_stretch_of_the_best_counts() {
        assert_eq!(middle_of_best(&[3, 5, 4, 5, 5, 5, 1]), 4);
        assert_eq!(middle_of_best(&[5, 5, 4, 5]), 0);
        assert_eq!(middle_of_best(&[1]), 0);
    }
}
