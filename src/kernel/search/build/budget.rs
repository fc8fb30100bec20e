//! What a search that comes to its bounds still counts: more with more nodes and more memory, never less.
//!
//! A diagram cut down to a budget keeps a part of the nodes of each layer, and a larger budget, spent in the early layers, may
//! keep others that lead to fewer variants. So the search is made again within each smaller round budget (1, 2 or 5 times a power of
//! ten), and the best of them stands: a larger budget has all the searches of a smaller one, and more.

use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::{Diagram, Stop};
use num_bigint::BigUint;

/// Round budgets, the smallest that is tried first.
fn rungs() -> impl Iterator<Item = usize> {
    let tens = std::iter::successors(Some(100usize), |n| n.checked_mul(10));
    tens.flat_map(|n| [1, 2, 5].into_iter().filter_map(move |k| n.checked_mul(k)))
}

/// Builds a diagram within limits.
pub(in crate::search) type Build<'a> = &'a mut dyn FnMut(&Limits) -> Diagram;

/// What a diagram is worth.
pub(in crate::search) type Worth<'a> = &'a dyn Fn(&Diagram) -> BigUint;

/// The best, by what it is `worth`, of a diagram cut down to its limits and of those within round budgets.
///
/// # Complexity
/// Twice the largest of them, and the worth of each.
pub(in crate::search) fn best(
    limits: &Limits,
    whole: Diagram,
    build: Build<'_>,
    worth: Worth<'_>,
) -> Diagram {
    let why = whole.stop;
    let mut best: Option<(BigUint, Diagram)> = None;
    for nodes in rungs().take_while(|&n| n < limits.nodes) {
        let limits = Limits {
            nodes,
            ..limits.clone()
        };
        let diagram = build(&limits);
        if diagram.stop == Stop::Interrupted {
            return diagram;
        }
        // Where memory cuts depends on how much there is: with more of it there would not be the same diagram. A larger budget
        // comes to the same.
        if diagram.stop == Stop::Memory {
            break;
        }
        best = better(best, diagram, worth);
    }
    let is_rung = rungs()
        .take_while(|&n| n <= limits.nodes)
        .any(|n| n == limits.nodes);
    if best.is_none() || (is_rung && whole.stop == Stop::NodeBudget) {
        best = better(best, whole, worth);
    }
    let (_, found) = best.expect("one was taken");
    Diagram { stop: why, ..found }
}

/// The better of what was found and a diagram; the first of equals.
fn better(
    best: Option<(BigUint, Diagram)>,
    diagram: Diagram,
    worth: Worth<'_>,
) -> Option<(BigUint, Diagram)> {
    let worth = worth(&diagram);
    match best {
        Some((most, known)) if worth <= most => Some((most, known)),
        _ => Some((worth, diagram)),
    }
}
