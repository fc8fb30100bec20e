//! The diagrams that answer a question: of the determinate variants, and of the admissible ones.

pub(in crate::search) mod budget;
pub(in crate::search) mod complements;
pub mod orders;
pub(in crate::search) mod self_stress;
pub(in crate::search) mod staging;
pub(in crate::search) mod two_sided;

use crate::search::answer::counts::total;
use crate::search::answer::estimate::Estimate;
use crate::search::answer::estimate::estimate;
use crate::search::answer::proven_cheapest::UpTo;
use crate::search::answer::proven_cheapest::cost_of;
use crate::search::answer::proven_cheapest::up_to;
use crate::search::build::orders::{Orders, orders};
use crate::search::build::self_stress::{in_self_stress_space, nothing};
use crate::search::build::staging::both_ends;
use crate::search::build::staging::laid;
use crate::search::build::two_sided::two_sided;
use crate::search::diagram::completion::{Ceiling, Missing};
use crate::search::diagram::product::product;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::Stage;
use crate::search::diagram::{self, Diagram, Progress, Stop};
use crate::search::question::Question;
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
    /// The cheapest of the admissible ones, where they are wanted and that diagram is not whole.
    pub cheapest: Option<UpTo>,
    /// About how many determinate and admissible variants there are, where their diagrams are cut down and a seed is given.
    pub estimates: [Option<Estimate>; 2],
    /// The variables in the order the admissible diagram takes them.
    pub order: Vec<usize>,
    /// Rows of the closure equations for each contour that they are built of: fewer than a twist has numbers where the rest is
    /// the same whatever is chosen; of each part, where the equations fall apart into two that choices change.
    pub rows_per_contour: Vec<usize>,
}

impl Diagrams {
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

/// Stages of a diagram, and its limits.
type Staged<'a> = (&'a [Stage], &'a Limits);
/// Builds a diagram under a ceiling.
type Build<'a> = &'a mut dyn FnMut(Staged<'_>, &mut Ceiling<'_>) -> Diagram;

/// Nodes from one end before a diagram is tried from both.
const AT_ONCE: usize = 200_000;

/// Whether a diagram is cut down to its limits.
fn is_cut(stop: Stop) -> bool {
    matches!(stop, Stop::NodeBudget | Stop::Memory)
}

/// Whether a diagram is whole and has no variant.
fn is_empty(of: &Diagram) -> bool {
    of.stop == Stop::Exhausted && of.terminals.is_empty()
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
pub fn build_in(
    question: &Question,
    orders: &Orders,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagrams {
    if let Some(out) = build_parts(question, orders, cancelled, progress) {
        return out;
    }
    let model = &question.least.whole;
    let laid = laid(question, orders, model);
    let first = (&laid.determinate.0[..], &laid.determinate.1);
    let mut whole = |staged: Staged<'_>, admissible: bool| {
        if !question.conditions.counted {
            return uncounted(question, staged, cancelled, progress);
        }
        let built = built(question, model, staged, admissible, cancelled, progress);
        if !is_cut(built.stop) {
            return built;
        }
        let (stages, limits) = staged;
        let build = &mut |limits: &Limits| {
            one_end(question, model, (stages, limits), None, cancelled, progress)
        };
        budget::best(limits, built, build, &|d| total(question, d, admissible))
    };
    let determinate = whole(first, false);
    let second = laid.admissible.as_ref().map(|(s, l)| (&s[..], l));
    let admissible = match second {
        // What is not determinate is not admissible.
        Some(_) if is_empty(&determinate) => nothing(model, &laid.order),
        Some(second) => whole(second, true),
        None => determinate.clone(),
    };
    let mut out = Diagrams {
        determinate,
        admissible,
        cheapest: None,
        estimates: [None; 2],
        order: laid.order,
        rows_per_contour: vec![model.space.dim],
    };
    let second = second.unwrap_or(first);
    let kept = if question.conditions.keep_output {
        question.least.whole.kept.len()
    } else {
        0
    };
    let build = &mut |staged: Staged<'_>, ceiling: &mut Ceiling<'_>| {
        one_end(question, model, staged, Some(ceiling), cancelled, progress)
    };
    prove(question, &mut out, second, kept, build);
    let estimate = |(stages, limits): Staged<'_>, end, stop, filter| {
        let seed = question.conditions.estimate.filter(|_| is_cut(stop))?;
        let missing = Missing::new(&question.least.whole.space, stages, limits, end);
        estimate(
            question,
            (stages, limits),
            &missing,
            (seed, filter),
            cancelled,
        )
    };
    out.estimates = [
        estimate(first, 0, out.determinate.stop, false),
        estimate(second, kept, out.admissible.stop, true),
    ];
    out
}

/// Builds both diagrams from those of the two parts that the closure equations fall apart into; none where they do not, or
/// where a diagram does not fit the limits.
fn build_parts(
    question: &Question,
    orders: &Orders,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Option<Diagrams> {
    let parts = question
        .least
        .parts
        .as_ref()
        .filter(|_| question.conditions.counted)?;
    let laid = parts.each_ref().map(|part| laid(question, orders, part));
    let mut both = |staged: [&(Vec<Stage>, Limits); 2], admissible: bool| {
        let mut built = |part: usize| {
            let (stages, limits) = staged[part];
            let own = (&stages[..], limits);
            let d = built(question, &parts[part], own, admissible, cancelled, progress);
            (d.stop == Stop::Exhausted).then_some(d)
        };
        product([&built(0)?, &built(1)?], &staged[0].1)
    };
    let [one, two] = &laid;
    let determinate = both([&one.determinate, &two.determinate], false)?;
    let admissible = match (&one.admissible, &two.admissible) {
        (Some(_), Some(_)) if is_empty(&determinate) => nothing(&parts[0], &one.order),
        (Some(one), Some(two)) => both([one, two], true)?,
        _ => determinate.clone(),
    };
    Some(Diagrams {
        determinate,
        admissible,
        cheapest: None,
        estimates: [None; 2],
        order: one.order.clone(),
        rows_per_contour: parts.iter().map(|p| p.space.dim).collect(),
    })
}

/// The diagram of a question from one end, cut down to its limits where it does not fit them; under a ceiling or not.
fn one_end(
    question: &Question,
    model: &Model,
    (stages, limits): Staged<'_>,
    ceiling: Option<&mut Ceiling<'_>>,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let (exact, space, within) = (&question.exact, &model.space, (limits, ceiling));
    diagram::build(exact, space, stages, within, cancelled, progress)
}

/// The diagram of a question: in the space dual to self-stresses where there is no searched state; otherwise, and where that does
/// not fit the limits, of the motions of live links, from one end; where that takes many nodes, from both; cut down to the limits
/// where none fits.
fn built(
    question: &Question,
    model: &Model,
    (stages, limits): Staged<'_>,
    admissible: bool,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let free_alone = question.conditions.state.is_none();
    let keep_output = admissible && question.conditions.keep_output;
    if free_alone {
        let order: Vec<usize> = stages.iter().map(|s| s.variable).collect();
        let asked = (&order[..], limits, keep_output);
        let added = in_self_stress_space(question, model, asked, cancelled, progress);
        if let Some(whole) = added {
            return whole;
        }
    }
    let has_halves = free_alone && limits.already >= limits.internal;
    let at_once = if has_halves { AT_ONCE } else { usize::MAX };
    let few = Limits {
        nodes: limits.nodes.min(at_once),
        ..limits.clone()
    };
    let built = one_end(question, model, (stages, &few), None, cancelled, progress);
    if !has_halves || !is_cut(built.stop) {
        return built;
    }
    let parts = both_ends(question, model, stages, keep_output);
    let halves = two_sided(
        question,
        model,
        &parts,
        (limits, keep_output),
        cancelled,
        progress,
    );
    match halves {
        Some(whole) => whole,
        None if few.nodes < limits.nodes => {
            one_end(question, model, (stages, limits), None, cancelled, progress)
        }
        None => built,
    }
}

/// The diagram of a question that is not to be counted.
fn uncounted(
    question: &Question,
    (stages, limits): Staged<'_>,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let few = &Limits {
        nodes: 1,
        ..limits.clone()
    };
    let model = &question.least.whole;
    let mut few = one_end(question, model, (stages, few), None, cancelled, progress);
    if few.stop != Stop::Interrupted {
        few.stop = Stop::NotCounted;
    }
    few
}

/// Finds the cheapest admissible variants where they are wanted and not all are known; `end` is the least dimension of
/// the last nodes.
fn prove(
    question: &Question,
    out: &mut Diagrams,
    staged: Staged<'_>,
    end: usize,
    build: Build<'_>,
) {
    let most = BigUint::from(question.conditions.cheapest);
    let known = matches!(out.admissible.stop, Stop::Exhausted | Stop::Interrupted);
    if known || most.is_zero() {
        return;
    }
    let missing = Missing::new(&question.least.whole.space, staged.0, staged.1, end);
    if missing.root().is_none() {
        // There is none, by dimensions alone.
        out.admissible.stop = Stop::Exhausted;
        return;
    }
    let known = cost_of(question, &out.admissible, &most).flatten();
    let build = &mut |ceiling: &mut Ceiling<'_>| build(staged, ceiling);
    let proof = up_to(question, &missing, (&most, known), build);
    match proof.up_to {
        // Nothing had to be left out: what has no completion by dimensions made the diagram too large.
        Some(all) if all.cost_milli == i64::MAX => out.admissible = all.diagram,
        up_to => out.cheapest = up_to,
    }
    // Where it was cancelled depends on the clock, so that there is nothing to compare with a twin.
    if proof.stop == Stop::Interrupted {
        out.admissible.stop = Stop::Interrupted;
    }
}
