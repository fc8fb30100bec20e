//! The diagrams that answer a question: of the determinate variants, and of the admissible ones.

pub(in crate::search) mod at_most;
pub(in crate::search) mod budget;
pub(in crate::search) mod completing_sets;
mod estimates;
mod known_spaces;
pub(in crate::search) mod known_variants;
pub mod orders;
mod path_tree;
pub(in crate::search) mod self_stress;
pub(in crate::search) mod spanning_halves;
mod spanning_paths;
pub(in crate::search) mod staging;
pub(in crate::search) mod two_sided;

use crate::search::answer::counts::total;
use crate::search::answer::estimate::Estimate;
use crate::search::answer::proven_cheapest::UpTo;
use crate::search::answer::proven_cheapest::cost_of;
use crate::search::answer::proven_cheapest::up_to;
use crate::search::build::at_most::at_most;
use crate::search::build::estimates::estimates;
use crate::search::build::orders::{Orders, orders};
use crate::search::build::self_stress::{Wanted, in_self_stress_space, nothing};
use crate::search::build::spanning_halves::Halves;
use crate::search::build::staging::{Laid, Staged, laid};
use crate::search::build::two_sided::two_sided;
use crate::search::diagram::completion::{Ceiling, Missing};
use crate::search::diagram::layer::CUT;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::Stage;
use crate::search::diagram::{self, Diagram, Progress, Stop};
use crate::search::question::Question;
use crate::search::question::throughout::PoseOnly;
use crate::search::reduce::plane_split::Model;
use num_bigint::BigUint;
use num_traits::Zero;

/// Diagrams of one question.
#[derive(Debug)]
pub struct Diagrams {
    /// Of the variants that meet the redundancy condition of the free state.
    pub determinate: Diagram,
    /// Of those that meet every condition that does not depend on counts of changes and mobility.
    pub admissible: Diagram,
    /// Of those of the admissible ones that keep the motion throughout, or why there is no such diagram.
    pub lasting: Result<Diagram, PoseOnly>,
    /// The cheapest of the admissible ones, where they are wanted and that diagram is not whole.
    pub cheapest: Option<UpTo>,
    /// About how many determinate and admissible variants there are, where their diagrams are cut down and a seed is given.
    pub estimates: [Option<Estimate>; 2],
    /// Rows of the closure equations for each contour that they are built of: fewer than a twist has numbers where the rest is
    /// the same whatever is chosen.
    pub rows_per_contour: usize,
}

impl Diagrams {
    /// The diagram of the variants that are listed: those that keep the motion throughout, where that is known, or else the admissible
    /// ones.
    #[must_use]
    pub fn listed(&self) -> &Diagram {
        self.lasting.as_ref().unwrap_or(&self.admissible)
    }

    /// The less complete of the two reasons for stopping.
    #[must_use]
    pub fn stop(&self) -> Stop {
        self.determinate.stop.or(self.admissible.stop)
    }

    /// The cost in thousandths up to which every admissible variant is known; `None` where of none it can be said.
    #[must_use]
    pub fn known_up_to(&self) -> Option<i64> {
        let whole = self.admissible.stop == Stop::Exhausted;
        let bounded = self.cheapest.as_ref().map(|c| c.cost_milli);
        if whole { Some(i64::MAX) } else { bounded }
    }
}

/// Builds a diagram under a ceiling.
type Build<'a> = &'a mut dyn FnMut(&mut Ceiling<'_>) -> Diagram;

fn is_whole(of: &Diagram) -> bool {
    of.stop == Stop::Exhausted
}

/// Whether a diagram is whole and has no variant.
fn is_empty(of: &Diagram) -> bool {
    is_whole(of) && of.terminals.is_empty()
}

/// Builds both diagrams.
pub fn build(
    question: &Question,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagrams {
    build_in(question, &orders(question), cancelled, progress)
}

/// Builds both diagrams in given orders.
pub(crate) fn build_in(
    question: &Question,
    orders: &Orders,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagrams {
    let best = &budget::best;
    build_with(question, orders, best, cancelled, progress)
}

/// Both diagrams, where they fit the limits; where they do not, nothing is made of what does.
pub(in crate::search) fn build_whole(
    question: &Question,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Diagrams> {
    let as_it_is: CutDown<'_> = &|_, cut, _, _| cut;
    let orders = orders(question);
    let out = build_with(question, &orders, as_it_is, cancelled, &mut |_| {});
    (out.stop() == Stop::Exhausted).then_some(out)
}

/// What is made of a diagram that does not fit its limits.
type CutDown<'a> = &'a dyn Fn(&Limits, Diagram, budget::Build<'_>, budget::Worth<'_>) -> Diagram;

fn build_with(
    question: &Question,
    orders: &Orders,
    cut_down: CutDown<'_>,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagrams {
    let model = &question.model;
    let Laid {
        determinate: first,
        admissible: second,
        order,
    } = laid(question, orders, model);
    let mut whole = |staged: &Staged<'_>, admissible: bool| {
        if !question.conditions.counted {
            return uncounted(question, staged, cancelled, progress);
        }
        let wanted = Wanted::of(question, admissible);
        let whole = built(question, staged, wanted, cancelled, progress);
        if !whole.stop.is_cut() {
            return whole;
        }
        let build = &mut |limits: &Limits| {
            within_limits(question, staged, limits, wanted, cancelled, progress)
        };
        let worth = |d: &Diagram| total(question, d, admissible);
        cut_down(&staged.limits, whole, build, &worth)
    };
    let determinate = whole(&first, false);
    let mut admissible = match &second {
        // What is not determinate is not admissible.
        Some(_) if is_empty(&determinate) => nothing(question, &order),
        Some(second) => whole(second, true),
        None => determinate.clone(),
    };
    let second = second.as_ref().unwrap_or(&first);
    let kept = usize::from(question.conditions.keep_output) * model.kept.len();
    let build = &mut |ceiling: &mut Ceiling<'_>| {
        let (stages, limits) = (second.stages(), &second.limits);
        let ceiling = Some(ceiling);
        one_end(
            question, model, stages, limits, ceiling, cancelled, progress,
        )
    };
    let cheapest = prove(question, &mut admissible, second, kept, build);
    let both = [&determinate, &admissible];
    let estimates = estimates(question, both, [&first, second], kept, cancelled);
    let lasting = build_lasting(question, orders, &admissible, cancelled, progress);
    Diagrams {
        determinate,
        admissible,
        lasting,
        cheapest,
        estimates,
        rows_per_contour: model.space.dim,
    }
}

/// Builds the diagram of the variants that keep the motion throughout, where the one of admissible variants is whole; or says why it is
/// not built.
fn build_lasting(
    question: &Question,
    orders: &Orders,
    at_the_pose: &Diagram,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Result<Diagram, PoseOnly> {
    let along = question.throughout.as_ref().map_err(PoseOnly::clone)?;
    if !is_whole(at_the_pose) {
        return Err(PoseOnly::Budget);
    }
    if is_empty(at_the_pose) {
        return Ok(at_the_pose.clone());
    }
    let laid = laid(question, orders, &along.model);
    let staged = laid.admissible.as_ref().unwrap_or(&laid.determinate);
    let built = built(question, staged, Wanted::Lasting, cancelled, progress);
    if is_whole(&built) {
        Ok(built)
    } else {
        Err(PoseOnly::Budget)
    }
}

/// The diagram of a question, of the motions of live links, cut down to its limits where it does not fit them; under a ceiling or not.
pub(in crate::search) fn one_end(
    question: &Question,
    model: &Model,
    stages: &[Stage],
    limits: &Limits,
    ceiling: Option<&mut Ceiling<'_>>,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let (field, space) = (question.exact.field(), &model.space);
    diagram::of_live_links(field, space, stages, limits, ceiling, cancelled, progress)
}

/// Nodes of a diagram before it is asked whether there is any variant at all, and built from both ends.
const AT_ONCE: usize = 20_000;

/// The diagram of a question: where it is not small and no state is searched, from both ends, or from one where that may take no longer;
/// where it does not fit the limits from both, or more redundant constraints are allowed than all variants have, from one; where that
/// does not fit either, cut down.
fn built(
    question: &Question,
    staged: &Staged<'_>,
    wanted: Wanted,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let limits = &staged.limits;
    let within = |limits: &Limits, progress: &mut (dyn FnMut(Progress) + Send)| {
        within_limits(question, staged, limits, wanted, cancelled, progress)
    };
    if question.conditions.state.is_some() {
        return within(limits, progress);
    }
    if limits.already > limits.internal {
        return nothing(question, &staged.order);
    }
    let few = Limits {
        nodes: limits.nodes.min(AT_ONCE),
        ..limits.clone()
    };
    let mut built = within(&few, progress);
    if !built.stop.is_cut() {
        return built;
    }
    let order = &staged.order;
    let most = at_most(question, order, &few, wanted, cancelled);
    if most.is_some_and(|m| m.diagram.terminals.is_empty()) {
        return nothing(question, order);
    }
    let mut from_one_end = |nodes: usize, progress: &mut (dyn FnMut(Progress) + Send)| {
        // What grows on and on is given up early.
        let limits = Limits {
            nodes: nodes.min(limits.nodes),
            layer: nodes / 3,
            ..limits.clone()
        };
        let found = (limits.nodes > few.nodes).then(|| within(&limits, progress))?;
        is_whole(&found).then_some(found)
    };
    let halves = Halves::new(question, order, limits, wanted);
    let space = &wanted.model(question).space;
    let whole = halves.and_then(|h| two_sided(&h, space, cancelled, progress, &mut from_one_end));
    if let Some(whole) = whole {
        return whole;
    }
    if few.nodes < limits.nodes {
        built = within(limits, progress);
    }
    built
}

/// The diagram of a question, cut down where it does not fit the limits: in the space dual to self-stresses where there is no searched
/// state and every choice has the motions of its present joint, otherwise of the motions of live links.
fn within_limits(
    question: &Question,
    staged: &Staged<'_>,
    limits: &Limits,
    wanted: Wanted,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    if question.conditions.state.is_none() {
        let order = &staged.order;
        let added = in_self_stress_space(question, order, limits, wanted, cancelled, progress);
        if let Some(added) = added {
            return added;
        }
    }
    let (model, stages) = (wanted.model(question), staged.stages());
    one_end(question, model, stages, limits, None, cancelled, progress)
}

/// The diagram of a question that is not to be counted.
fn uncounted(
    question: &Question,
    staged: &Staged<'_>,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let few = &Limits {
        nodes: CUT,
        ..staged.limits.clone()
    };
    let model = &question.model;
    let stages = staged.stages();
    let mut few = one_end(question, model, stages, few, None, cancelled, progress);
    if few.stop != Stop::Interrupted {
        few.stop = Stop::NotCounted;
    }
    few
}

/// Returns the cheapest admissible variants where they are wanted and not all are known; `end` is the least dimension of
/// the last nodes.
fn prove(
    question: &Question,
    admissible: &mut Diagram,
    staged: &Staged<'_>,
    end: usize,
    build: Build<'_>,
) -> Option<UpTo> {
    let most = BigUint::from(question.conditions.cheapest);
    let known = matches!(admissible.stop, Stop::Exhausted | Stop::Interrupted);
    if known || most.is_zero() {
        return None;
    }
    let space = &question.model.space;
    let missing = Missing::new(space, staged.stages(), &staged.limits, end);
    if missing.root().is_none() {
        // There is none, by dimensions alone.
        admissible.stop = Stop::Exhausted;
        return None;
    }
    let known = cost_of(question, admissible, &most).flatten();
    let proof = up_to(question, &missing, &most, known, build);
    let cheapest = match proof.up_to {
        // Nothing had to be left out: what has no completion by dimensions made the diagram too large.
        Some(all) if all.cost_milli == i64::MAX => {
            *admissible = all.diagram;
            None
        }
        up_to => up_to,
    };
    // Where it was cancelled depends on the clock, so that there is nothing to compare with a twin.
    if proof.stop == Stop::Interrupted {
        admissible.stop = Stop::Interrupted;
    }
    cheapest
}
