//! What tests alone need of the inside of a search, and nothing else may use.

use super::answer::ideas::ideas_in_steps;
use super::answer::k_best::{Cheapest, Reach};
use super::answer::keys::Key;
use super::diagram::minimize::minimize_diagram;
use super::diagram::{Diagram, Stop};
use super::question::Question;
use super::solve::Diagrams;
use super::solve::lanes::in_self_stress_space;
use super::solve::orders::{one_diagram, variable_orders};
use super::solve::self_stress::{Wanted, diagram_limits};
use super::solve::spanning_halves::Halves;
use super::solve::two_sided::two_sided;
use crate::search::diagram::Control;

/// Returns the diagrams of a question that fit the limits, minimized: each as built from one end and from both ends. The second is `None`
/// if more redundant constraints are allowed than every variant has. Those of variants that keep the motion throughout are built within the
/// admissible ones from one end and not from the other, and the other way round.
#[must_use]
pub fn from_both_ends(question: &Question) -> Vec<[Option<Diagram>; 2]> {
    let (orders, limits) = (variable_orders(question), diagram_limits(question));
    let mut both = vec![(&orders.determinate, Wanted::Determinate)];
    if !one_diagram(question) {
        both.push((&orders.admissible, Wanted::Admissible));
    }
    let of = |order: &[usize], [wanted, as_well]: [Wanted<'_>; 2]| {
        let one = in_self_stress_space(question, order, &limits, wanted, Control::NONE);
        let halves = Halves::new(question, order, &limits, as_well);
        let space = &question.space;
        let both = halves.and_then(|halves| two_sided(&halves, space, Control::NONE));
        (one.stop == Stop::Exhausted)
            .then(|| [Some(one), both].map(|d| d.map(|d| minimize_diagram(d.layers, d.terminals))))
    };
    let mut out: Vec<_> = both
        .into_iter()
        .filter_map(|(order, wanted)| of(order, [wanted, wanted]))
        .collect();
    let known = out.get(1).and_then(|[one, _]| one.clone());
    if let (Some(known), Ok(_)) = (known, &question.throughout) {
        let within = Wanted::Lasting(Some(&known));
        let alone = Wanted::Lasting(None);
        let ways = [[within, alone], [alone, within]].into_iter();
        out.extend(ways.filter_map(|ways| of(&orders.admissible, ways)));
    }
    out
}

/// How long a list is, and how many steps down a diagram it took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Walked {
    /// Variants or ideas.
    pub listed: usize,
    /// Steps, each from a node to one in the next layer.
    pub steps: usize,
}

/// Returns the number of steps needed to list the cheapest admissible variants.
#[must_use]
pub fn walked_for_variants(question: &Question, found: &Diagrams, top: usize) -> Walked {
    let mut steps = 0;
    let enter = |_: usize, _: usize, _: Key, _: &[usize]| {
        steps += 1;
        true
    };
    let (diagram, reach) = (&found.admissible, Reach::Variants(top, u64::MAX));
    let enter = Box::new(enter);
    let listed = Cheapest::new(question, diagram, &question.steps, reach, &|_| true, enter);
    let listed = listed.count();
    Walked { listed, steps }
}

/// Returns the number of steps needed to list the first ideas.
#[must_use]
pub fn walked_for_ideas(question: &Question, found: &Diagrams, top: usize) -> Walked {
    let mut steps = 0;
    let listed = ideas_in_steps(
        question,
        &question.idea_basis(),
        &question.idea_variants(found),
        top,
        &mut steps,
    )
    .len();
    Walked { listed, steps }
}
