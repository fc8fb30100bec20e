//! The diagrams that answer a question: of the determinate variants, and of the admissible ones.

pub(in crate::search) mod at_most;
pub(in crate::search) mod known_variants;
pub(in crate::search) mod lanes;
mod matching_halves;
pub mod orders;
pub(in crate::search) mod self_stress;
pub(in crate::search) mod spanning_halves;
mod spanning_pairs;
pub(in crate::search) mod two_sided;

use crate::search::answer::estimate::{Estimate, estimate_counts};
use crate::search::answer::proven_cheapest::{UpTo, cost_of, up_to};
use crate::search::diagram::completion::Missing;
use crate::search::diagram::layer::CUT;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::{self, Control, Diagram, Omitted, Stop};
use crate::search::question::Question;
use crate::search::question::throughout::PoseOnly;
use crate::search::solve::at_most::at_most;
use crate::search::solve::lanes::{Lanes, in_self_stress_space};
use crate::search::solve::orders::{Orders, one_diagram, variable_orders};
use crate::search::solve::self_stress::{Wanted, diagram_limits, empty_diagram};
use crate::search::solve::spanning_halves::Halves;
use crate::search::solve::two_sided::two_sided;
use num_bigint::BigUint;
use num_traits::Zero;

/// Diagrams of one question.
#[derive(Debug)]
pub struct Diagrams {
    /// The variants that meet the redundancy condition of the free state.
    pub determinate: Diagram,
    /// The variants that meet every condition except those on mobility and changes.
    pub admissible: Diagram,
    /// The admissible variants that keep the motion throughout, or the reason why there is no such diagram.
    pub lasting: Result<Diagram, PoseOnly>,
    /// The cheapest of the admissible ones, where they are wanted and that diagram is not whole.
    pub cheapest: Option<UpTo>,
    /// About how many determinate and admissible variants there are, where their diagrams are cut down and a seed is given.
    pub estimates: [Option<Estimate>; 2],
    /// Rows of the closure equations for each contour.
    pub rows_per_contour: usize,
}

impl Diagrams {
    /// Returns the diagram of the listed variants: those that keep the motion throughout if that is known, otherwise the admissible ones.
    #[must_use]
    pub fn listed_diagram(&self) -> &Diagram {
        self.lasting.as_ref().unwrap_or(&self.admissible)
    }

    /// Returns the less complete of the two reasons for stopping.
    #[must_use]
    pub fn stop_reason(&self) -> Stop {
        self.determinate.stop.combine_with(self.admissible.stop)
    }

    /// Returns the cost in thousandths up to which every admissible variant is known; `None` if there is no such cost.
    #[must_use]
    pub fn known_up_to(&self) -> Option<i64> {
        let whole = self.admissible.stop == Stop::Exhausted;
        let bounded = self.cheapest.as_ref().map(|c| c.cost_milli);
        if whole { Some(i64::MAX) } else { bounded }
    }
}

fn is_whole(of: &Diagram) -> bool {
    of.stop == Stop::Exhausted
}

/// Returns true if a diagram is whole and has no variants.
fn is_empty(of: &Diagram) -> bool {
    is_whole(of) && of.terminals.is_empty()
}

/// Builds the diagrams of a question.
pub fn build_diagrams(question: &Question, control: Control<'_>) -> Diagrams {
    build_in(question, &variable_orders(question), control)
}

/// Builds the diagrams of a question in given orders.
pub(crate) fn build_in(question: &Question, orders: &Orders, control: Control<'_>) -> Diagrams {
    let limits = diagram_limits(question);
    let of = |order: &[usize], wanted| build_whole(question, order, &limits, wanted, control);
    let determinate = of(&orders.determinate, Wanted::Determinate);
    let order = &orders.admissible;
    let mut admissible = if one_diagram(question) {
        determinate.clone()
    } else if is_empty(&determinate) {
        // What is not determinate is not admissible.
        empty_diagram(question, order)
    } else {
        of(order, Wanted::Admissible)
    };
    let cheapest = prove_cheapest(question, &mut admissible, order, &limits, control);
    let both = [&determinate, &admissible];
    let estimates = estimate_counts(question, both, orders, &limits, control.cancelled);
    let lasting = build_lasting(question, order, &admissible, control);
    Diagrams {
        determinate,
        admissible,
        lasting,
        cheapest,
        estimates,
        rows_per_contour: question.space.dim,
    }
}

/// Builds the diagram of the variants that keep the motion throughout, where the one of admissible variants is whole; or says why it is
/// not built.
fn build_lasting(
    question: &Question,
    order: &[usize],
    at_the_pose: &Diagram,
    control: Control<'_>,
) -> Result<Diagram, PoseOnly> {
    question.throughout.as_ref().map_err(PoseOnly::clone)?;
    if !is_whole(at_the_pose) {
        return Err(PoseOnly::Budget);
    }
    if is_empty(at_the_pose) {
        return Ok(at_the_pose.clone());
    }
    // It is wanted whole or not at all.
    let limits = Limits {
        layer: question.conditions.nodes,
        ..diagram_limits(question)
    };
    let built = build_whole(
        question,
        order,
        &limits,
        Wanted::Lasting(Some(at_the_pose)),
        control,
    );
    if is_whole(&built) {
        Ok(built)
    } else {
        Err(PoseOnly::Budget)
    }
}

/// Nodes of a diagram before it is asked whether there is any variant at all, and built from both ends.
const AT_ONCE: usize = 40_000;

/// Returns the diagram of a question, cut down where it does not fit the limits; from both ends where from one it grows too large.
fn build_whole(
    question: &Question,
    order: &[usize],
    limits: &Limits,
    wanted: Wanted<'_>,
    control: Control<'_>,
) -> Diagram {
    let within = |limits: &Limits| in_self_stress_space(question, order, limits, wanted, control);
    if !question.conditions.counted {
        let few = Limits {
            nodes: CUT,
            ..limits.clone()
        };
        let mut few = within(&few);
        if few.stop != Stop::Interrupted {
            few.stop = Stop::NotCounted;
        }
        return few;
    }
    if question.conditions.state.is_some() {
        return within(limits);
    }
    let few = Limits {
        nodes: limits.nodes.min(AT_ONCE),
        ..limits.clone()
    };
    let built = within(&few);
    if !built.stop.is_cut() {
        return built;
    }
    let most = at_most(question, order, &few, wanted, control.cancelled);
    if most.is_some_and(|m| m.diagram.terminals.is_empty()) {
        return empty_diagram(question, order);
    }
    let halves = Halves::new(question, order, limits, wanted);
    let whole = halves.and_then(|h| two_sided(&h, &question.space, control));
    let mut found = match whole {
        Some(whole) => whole,
        None if few.nodes < limits.nodes => within(limits),
        None => built,
    };
    if found.stop.is_cut() && (control.cancelled)() {
        found.stop = Stop::Interrupted;
    }
    found
}

/// Returns the cheapest admissible variants where they are wanted and not all are known.
fn prove_cheapest(
    question: &Question,
    admissible: &mut Diagram,
    order: &[usize],
    limits: &Limits,
    control: Control<'_>,
) -> Option<UpTo> {
    let most = BigUint::from(question.conditions.cheapest);
    let known = matches!(admissible.stop, Stop::Exhausted | Stop::Interrupted);
    if known || most.is_zero() {
        return None;
    }
    let Lanes { stages, root } = Lanes::new(question, order, limits, Wanted::Admissible);
    let space = &question.space;
    let missing = Missing::new(space, &stages, &root, limits);
    if missing.least_of_root().is_none() {
        // There is none, by dimensions alone.
        admissible.stop = Stop::Exhausted;
        return None;
    }
    let known = cost_of(question, admissible, &most).flatten();
    let proof = up_to(question, &missing, &most, known, &mut |ceiling| {
        let root = root.clone();
        let omitted = Omitted::Above(ceiling);
        diagram::build_layers(space, &stages, limits, root, omitted, control)
    });
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
