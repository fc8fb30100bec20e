//! What tests alone need of the inside of a search, and nothing else may use.

use super::answer::k_best::{Assignment, Cheapest, Reach};
use super::build::orders::orders;
use super::build::self_stress::in_self_stress_space;
use super::build::staging::laid;
use super::build::{build, one_end};
use super::diagram::minimize::minimal;
use super::diagram::{Diagram, Stop};
use super::question::Question;

/// The diagrams of a question as made of motions of live links and in the space dual to self-stresses, each the smallest there is;
/// those of which the first is made within the limits.
#[must_use]
pub fn in_both_spaces(question: &Question) -> Vec<[Option<Diagram>; 2]> {
    let model = &question.least.whole;
    let laid = laid(question, &orders(question), model);
    let keep_output = question.conditions.keep_output;
    let both = [
        Some((&laid.determinate, false)),
        laid.admissible.as_ref().map(|s| (s, keep_output)),
    ];
    let mut found = Vec::new();
    for (staged, keep_output) in both.into_iter().flatten() {
        let (stages, limits) = (staged.stages(), &staged.limits);
        let never = || false;
        let one = one_end(question, model, stages, limits, None, &never, &mut |_| {});
        if one.stop != Stop::Exhausted {
            continue;
        }
        let other = in_self_stress_space(
            question,
            model,
            &staged.order,
            limits,
            keep_output,
            &never,
            &mut |_| {},
        );
        found.push([Some(one), other].map(|d| d.map(|d| minimal(d.layers, d.terminals))));
    }
    found
}

/// The cheapest admissible variants of a question where so many steps from nodes are kept at once.
#[must_use]
pub fn cheapest_in_room(question: &Question, room: usize, top: usize) -> Vec<Assignment> {
    let found = build(question, &|| false, &mut |_| {});
    let mut all = Cheapest::<u128>::new(
        &found.admissible,
        &question.steps,
        (Reach::Variants(top), u64::MAX),
        |_| true,
        |k| k,
        usize::MAX,
        Box::new(|_, _, _, _| true),
    );
    all.ways.room = room;
    all.collect()
}
