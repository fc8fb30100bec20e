//! About how many variants there are, where a diagram is cut down to its limits.

use crate::search::answer::counts::total;
use crate::search::answer::estimate::{Estimate, WITHIN};
use crate::search::answer::random_cuts;
use crate::search::answer::samples::SetSamples;
use crate::search::build::at_most::at_most;
use crate::search::build::staging::Staged;
use crate::search::diagram::completion::Missing;
use crate::search::diagram::{Diagram, Stop};
use crate::search::question::Question;
use num_bigint::BigUint;

/// About how many variants there are, determinate and admissible ones, of diagrams that are cut; `kept` is the least dimension of the last
/// nodes of the admissible one.
pub(super) fn estimates(
    question: &Question,
    [determinate, admissible]: [&Diagram; 2],
    [first, second]: [&Staged<'_>; 2],
    kept: usize,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> [Option<Estimate>; 2] {
    let seed = match question.conditions.estimate {
        Some(seed) if determinate.stop.or(admissible.stop).is_cut() => seed,
        _ => return [None, None],
    };
    let estimate = |staged, end, diagram: &Diagram, admissible, possible: Option<&BigUint>| {
        if !diagram.stop.is_cut() {
            return None;
        }
        let found = estimated(question, staged, end, seed, admissible, cancelled)?;
        Some(found.bounded(&total(question, diagram, admissible), possible))
    };
    let first = estimate(first, 0, determinate, false, None);
    let possible = match &first {
        Some(e) => e.at_most.clone(),
        None => (determinate.stop == Stop::Exhausted).then(|| total(question, determinate, false)),
    };
    let second = estimate(second, kept, admissible, true, possible.as_ref());
    [first, second]
}

/// About how many variants there are, determinate or admissible ones: by samples of a larger set where there is no searched state and
/// no redundant constraint is allowed, else by random cuts, and so where those are surer because few samples are wanted; `end` is the
/// least dimension of the last nodes.
fn estimated(
    question: &Question,
    staged: &Staged<'_>,
    end: usize,
    seed: u64,
    admissible: bool,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Estimate> {
    let (model, limits) = (&question.least.whole, &staged.limits);
    let by_cuts = || {
        let stages = staged.stages();
        let missing = Missing::new(&model.space, stages, limits, end);
        random_cuts::estimate(
            question, stages, limits, &missing, seed, admissible, cancelled,
        )
    };
    if question.conditions.state.is_some() {
        return by_cuts();
    }
    let keep_output = admissible && question.conditions.keep_output;
    let order = &staged.order;
    let of = at_most(question, model, order, limits, keep_output, cancelled);
    let samples = of.as_ref();
    let samples =
        samples.and_then(|of| SetSamples::begin(question, of, seed, admissible, cancelled));
    let Some(samples) = samples else {
        return by_cuts();
    };
    let reach = samples.reach();
    let surer = |cuts: &Estimate| cuts.reach() < reach;
    match (reach > WITHIN).then(by_cuts).flatten().filter(surer) {
        Some(cuts) => Some(Estimate {
            at_most: Some(samples.at_most()),
            ..cuts
        }),
        None => samples.estimate(cancelled),
    }
}
