//! About how many variants there are, where a diagram is cut down to its limits.

use crate::search::answer::counts::total;
use crate::search::answer::estimate::{Estimate, WITHIN};
use crate::search::answer::random_cuts;
use crate::search::answer::samples::SetSamples;
use crate::search::build::at_most::at_most;
use crate::search::build::staging::Staged;
use crate::search::build::{Diagrams, is_cut, is_whole};
use crate::search::diagram::Diagram;
use crate::search::diagram::completion::Missing;
use crate::search::question::Question;
use num_bigint::BigUint;

/// About how many variants there are, determinate and admissible ones, of diagrams that are cut; `kept` is the least dimension of the last
/// nodes of the admissible one.
pub(super) fn estimates(
    question: &Question,
    built: &Diagrams,
    [first, second]: [&Staged<'_>; 2],
    kept: usize,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> [Option<Estimate>; 2] {
    let seed = match question.conditions.estimate {
        Some(seed) if is_cut(built.stop()) => seed,
        _ => return [None, None],
    };
    let estimate = |staged, end, diagram: &Diagram, admissible, possible: Option<&BigUint>| {
        if !is_cut(diagram.stop) {
            return None;
        }
        let found = estimated(question, staged, end, seed, admissible, cancelled)?;
        Some(found.bounded(&total(question, diagram, admissible), possible))
    };
    let determinate = estimate(first, 0, &built.determinate, false, None);
    let possible = match &determinate {
        Some(e) => e.at_most.clone(),
        None => is_whole(&built.determinate).then(|| total(question, &built.determinate, false)),
    };
    let admissible = estimate(second, kept, &built.admissible, true, possible.as_ref());
    [determinate, admissible]
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
