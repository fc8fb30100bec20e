//! About how many variants there are, where a diagram is cut down to its limits.

use crate::search::answer::counts::total;
use crate::search::answer::estimate::completion_shares::CompletionShares;
use crate::search::answer::estimate::random_cuts::{self, Uncut};
use crate::search::answer::estimate::samples::SetSamples;
use crate::search::answer::estimate::{Estimate, WITHIN};
use crate::search::build::at_most::at_most;
use crate::search::build::self_stress::Wanted;
use crate::search::build::staging::Staged;
use crate::search::diagram::completion::Missing;
use crate::search::diagram::{Diagram, Over, Stop};

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
/// no redundant constraint is allowed, or, where these say too little because few of them are variants, by random cuts that this set
/// guides; by cuts that dimensions guide where there is no such set. `end` is the least dimension of the last nodes.
fn estimated(
    question: &Question,
    staged: &Staged<'_>,
    end: usize,
    seed: u64,
    admissible: bool,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Estimate> {
    let (model, limits) = (&question.model, &staged.limits);
    let by_dimension = || {
        let stages = staged.stages();
        let missing = Missing::new(&model.space, stages, limits, end);
        let field = question.exact.field();
        let over = |stage| Over::new(field, &model.space, stage, limits);
        let uncut = Uncut {
            stages: stages.iter().map(over).collect(),
            limits,
            already: limits.already,
            shares: CompletionShares::ByDimension(&missing),
        };
        random_cuts::estimate(question, &uncut, seed, admissible, cancelled)
    };
    if question.conditions.state.is_some() {
        return by_dimension();
    }
    let wanted = Wanted::of(question, admissible);
    let order = &staged.order;
    let Some(of) = at_most(question, order, limits, wanted, cancelled) else {
        return by_dimension();
    };
    let Some(samples) = SetSamples::begin(question, &of, seed, admissible, cancelled) else {
        return by_dimension();
    };
    let reach = samples.reach();
    let within = || {
        let uncut = Uncut {
            stages: of.stages(limits),
            limits,
            already: of.already,
            shares: CompletionShares::within(&of.diagram),
        };
        random_cuts::estimate(question, &uncut, seed, admissible, cancelled)
    };
    let surer = |cuts: &Estimate| cuts.reach() < reach;
    match (reach > WITHIN).then(within).flatten().filter(surer) {
        Some(cuts) => Some(Estimate {
            at_most: Some(samples.at_most()),
            ..cuts
        }),
        None => samples.estimate(cancelled),
    }
}
