//! What tests alone need of the inside of a search, and nothing else may use.

use super::answer::ideas::{IdeaBasis, idea_variants, ideas_in_steps};
use super::answer::k_best::{Assignment, Cheapest, Enter, ListLimits, Reach};
use super::answer::keys::Key;
use super::build::orders::orders;
use super::build::self_stress::{Wanted, in_self_stress_space};
use super::build::spanning_halves::Halves;
use super::build::staging::{Staged, laid};
use super::build::two_sided::two_sided;
use super::build::{Diagrams, build, one_end};
use super::diagram::minimize::minimal;
use super::diagram::{Diagram, Stop};
use super::question::Question;

/// The diagrams of a question as made of motions of live links, of those that are made so within the limits, each beside the
/// one that is made in another way; all the smallest there are.
fn beside(
    question: &Question,
    other: impl Fn(&Staged<'_>, Wanted) -> Option<Diagram>,
) -> Vec<[Option<Diagram>; 2]> {
    let model = &question.model;
    let laid = laid(question, &orders(question), model);
    let keeping = Wanted::of(question, true);
    let both = [
        Some((&laid.determinate, Wanted::Determinate)),
        laid.admissible.as_ref().map(|s| (s, keeping)),
    ];
    let mut found = Vec::new();
    for (staged, wanted) in both.into_iter().flatten() {
        let (stages, limits) = (staged.stages(), &staged.limits);
        let never = || false;
        let one = one_end(question, model, stages, limits, None, &never, &mut |_| {});
        if one.stop != Stop::Exhausted {
            continue;
        }
        let both = [Some(one), other(staged, wanted)];
        found.push(both.map(|d| d.map(|d| minimal(d.layers, d.terminals))));
    }
    found
}

/// The diagrams of a question as made of motions of live links and in the space dual to self-stresses.
#[must_use]
pub fn in_both_spaces(question: &Question) -> Vec<[Option<Diagram>; 2]> {
    beside(question, |staged, wanted| {
        in_self_stress_space(
            question,
            &staged.order,
            &staged.limits,
            wanted,
            &|| false,
            &mut |_| {},
        )
    })
}

/// The diagrams of a question as made of motions of live links, and from both ends; none of the latter where more redundant
/// constraints are allowed than all variants have.
#[must_use]
pub fn from_both_ends(question: &Question) -> Vec<[Option<Diagram>; 2]> {
    let model = &question.model;
    beside(question, |staged, wanted| {
        let (order, limits) = (&staged.order, &staged.limits);
        let halves = Halves::new(question, order, limits, wanted)?;
        two_sided(
            &halves,
            &model.space,
            &|| false,
            &mut |_| {},
            &mut |_, _| None,
        )
    })
}

/// The cheapest admissible variants of a question where so many steps from nodes are kept at once.
#[must_use]
pub fn cheapest_in_room(question: &Question, room: usize, top: usize) -> Vec<Assignment> {
    let found = build(question, &|| false, &mut |_| {});
    let mut all = cheapest(question, &found, top, Box::new(|_, _, _, _| true));
    all.ways.room = room;
    all.collect()
}

fn cheapest<'d>(
    question: &'d Question,
    found: &'d Diagrams,
    top: usize,
    enter: Enter<'d>,
) -> Cheapest<'d, u128> {
    let limits = ListLimits {
        reach: Reach::Variants(top),
        ceiling: u64::MAX,
    };
    Cheapest::new(
        &found.admissible,
        &question.steps,
        limits,
        |_| true,
        |k| k,
        usize::MAX,
        enter,
    )
}

/// How long a list is, and how many steps down a diagram it took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Walked {
    /// Variants or ideas.
    pub listed: usize,
    /// Steps, each from a node to one in the next layer.
    pub steps: usize,
}

/// What it takes to list the cheapest admissible variants.
#[must_use]
pub fn walked_for_variants(question: &Question, found: &Diagrams, top: usize) -> Walked {
    let mut steps = 0;
    let enter = |_: usize, _: usize, _: Key, _: &[usize]| {
        steps += 1;
        true
    };
    let listed = cheapest(question, found, top, Box::new(enter)).count();
    Walked { listed, steps }
}

/// What it takes to list the first ideas.
#[must_use]
pub fn walked_for_ideas(question: &Question, found: &Diagrams, top: usize) -> Walked {
    let mut steps = 0;
    let listed = ideas_in_steps(
        question,
        &IdeaBasis::of(question),
        &idea_variants(question, found),
        top,
        &mut steps,
    )
    .len();
    Walked { listed, steps }
}
