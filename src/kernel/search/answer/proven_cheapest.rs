//! The cheapest variants, proven to be, of a diagram too large to build.
//!
//! A diagram under a cost ceiling has every variant within it. It is small if the ceiling is low: nodes are removed if their cost and the
//! least cost of their completion exceed it. The ceiling is raised until it allows enough variants.
//!
//! # Sources
//! Korf, "Depth-first iterative-deepening", Artificial Intelligence 27 (1985), raises ceilings until there is an answer.
//! Sarkar, Chakrabarti, Ghose, De Sarkar, "Reducing reexpansions in iterative-deepening search by controlling cutoff
//! bounds", Artificial Intelligence 50 (1991): each step about doubles the work.

use crate::search::answer::counts::counts_by_cost;
use crate::search::diagram::completion::{Ceiling, Missing};
use crate::search::diagram::{Diagram, Stop};
use crate::search::question::Question;
use num_bigint::BigUint;
use num_traits::Zero;

/// A diagram that has every variant up to a cost.
#[derive(Debug, Clone)]
pub struct UpTo {
    /// The diagram; it has some dearer variants, too.
    pub diagram: Diagram,
    /// The cost. `[thousandths]`
    pub cost_milli: i64,
}

/// The proven part, and the reason why there is no more.
pub(in crate::search) struct Proof {
    pub(in crate::search) up_to: Option<UpTo>,
    pub(in crate::search) stop: Stop,
}

/// Returns a diagram of all variants up to the cost of the `most` cheapest, or up to the highest cost that the budget
/// allows. `known` is the cost of that many variants, if so many are already known.
pub(in crate::search) fn up_to(
    question: &Question,
    missing: &Missing,
    most: &BigUint,
    mut known: Option<i64>,
    build: &mut dyn FnMut(&mut Ceiling<'_>) -> Diagram,
) -> Proof {
    let mut up_to = None;
    let mut next = missing.least_of_root();
    while let Some(cost) = next {
        let mut ceiling = Ceiling::new(missing, cost);
        let diagram = build(&mut ceiling);
        if diagram.stop != Stop::Exhausted {
            let stop = diagram.stop;
            return Proof { up_to, stop };
        }
        let Some(found) = cost_of(question, &diagram, most) else {
            let stop = Stop::Memory;
            return Proof { up_to, stop };
        };
        // Each ceiling lets through what was left out under the one before, about as much again as there was.
        let mut more = 0;
        let raised = ceiling.beyond.iter().find(|(_, n)| {
            more += **n;
            more >= diagram.nodes
        });
        let raised = raised.or(ceiling.beyond.last_key_value()).map(|(c, _)| *c);
        known = known.into_iter().chain(found).min();
        next = raised.map(|raised| known.map_or(raised, |k| raised.min(k)));
        let cost_milli = if raised.is_some() { cost } else { i64::MAX };
        up_to = Some(UpTo {
            diagram,
            cost_milli,
        });
        if known.is_some_and(|k| k <= cost) {
            break;
        }
    }
    Proof {
        up_to,
        stop: Stop::Exhausted,
    }
}

/// Returns the cost in thousandths up to which a diagram has at least `most` variants. The inner `None` means that it has fewer, the outer
/// one that memory does not suffice.
pub(in crate::search) fn cost_of(
    question: &Question,
    diagram: &Diagram,
    most: &BigUint,
) -> Option<Option<i64>> {
    let by_cost = counts_by_cost(question, diagram)?;
    let mut sum = BigUint::zero();
    let reached = by_cost.iter().find(|(_, n)| {
        sum += *n;
        sum >= *most
    });
    Some(reached.map(|(cost, _)| *cost))
}
