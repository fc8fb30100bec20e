//! The search over a second prime: what one prime says of the diagram, the other must say too.
//!
//! A rank modulo a prime is too small if the prime divides a nonzero minor. Above 2^61 that is next to impossible by chance,
//! and primes that follow from a hash of the coordinates divide none by design. A second prime makes it still less likely.
//! Both diagrams number their nodes in the order in which they are met, so agreement is equality edge by edge. Then every
//! count, every list and every sample drawn from them is equal too.

use crate::search::answer::search_counts::SearchCounts;
use crate::search::diagram::{Control, Diagram, Stop};
use crate::search::question::Question;
use crate::search::solve::Diagrams;
use crate::search::solve::build_in;
use crate::search::solve::orders::variable_orders;
use num_bigint::BigUint;
use thiserror::Error;

/// A search checked by a second prime.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PrimeCheck {
    /// Both primes.
    pub primes: [u64; 2],
    /// Whether they agree. False only if the search was interrupted: then nothing was compared, because the clock decides where it ends.
    pub agree: bool,
}

/// Two primes that give different answers.
#[derive(Debug, Clone, Error)]
#[error(
    "two primes disagree, so neither answer is given. Modulo {}: {} determinate and {} admissible variants. Modulo {}: \
     {} determinate and {} admissible variants. One of the primes divides a minor of \
     this geometry, perhaps a coordinate itself; give the coordinates in other units or with fewer digits",
    primes[0], determinate[0], admissible[0], primes[1], determinate[1], admissible[1]
)]
pub struct Disagreement {
    /// The primes.
    pub primes: [u64; 2],
    /// Determinate variants modulo each.
    pub determinate: [BigUint; 2],
    /// Admissible variants modulo each.
    pub admissible: [BigUint; 2],
}

/// Builds the diagrams of a search and of its twin over another prime, in parallel.
pub fn build_both(questions: [&Question; 2], control: Control<'_>) -> (Diagrams, Diagrams) {
    let [first, second] = questions;
    let orders = variable_orders(first);
    rayon::join(
        || build_in(first, &orders, control),
        || build_in(second, &orders, Control::cancelled_by(control.cancelled)),
    )
}

/// Compares the diagrams of a search with those of its twin over another prime.
///
/// # Errors
/// Returns an error with both counts if the diagrams differ, even if the counts are equal.
///
/// # Complexity
/// O(edges) if the diagrams are equal, as they have always been. Otherwise both are counted.
pub fn compare_primes(
    questions: [&Question; 2],
    diagrams: [&Diagrams; 2],
) -> Result<PrimeCheck, Box<Disagreement>> {
    let check = |agree| PrimeCheck {
        primes: primes(questions),
        agree,
    };
    if diagrams
        .iter()
        .any(|d| d.stop_reason() == Stop::Interrupted)
    {
        return Ok(check(false));
    }
    let [a, b] = diagrams;
    let equal = have_same_edges(&a.determinate, &b.determinate)
        && have_same_edges(&a.admissible, &b.admissible)
        && match (&a.lasting, &b.lasting) {
            (Ok(a), Ok(b)) => have_same_edges(a, b),
            (a, b) => a.is_err() && b.is_err(),
        }
        && match (&a.cheapest, &b.cheapest) {
            (Some(a), Some(b)) => {
                a.cost_milli == b.cost_milli && have_same_edges(&a.diagram, &b.diagram)
            }
            (a, b) => a.is_none() && b.is_none(),
        }
        && questions[0].steps.keys == questions[1].steps.keys;
    if equal {
        return Ok(check(true));
    }
    let counts = [0, 1].map(|i| SearchCounts::of_diagrams(questions[i], diagrams[i]));
    Err(make_disagreement(questions, counts.each_ref()))
}

/// Returns the error of two primes that differ in something.
fn make_disagreement(questions: [&Question; 2], counts: [&SearchCounts; 2]) -> Box<Disagreement> {
    Box::new(Disagreement {
        primes: primes(questions),
        determinate: counts.map(|c| c.determinate.total.clone()),
        admissible: counts.map(|c| c.admissible.total.clone()),
    })
}

/// Compares counts that were made over the primes of two searches.
///
/// # Errors
/// Returns an error with both if they differ.
pub fn compare_counts(
    questions: [&Question; 2],
    counts: [&SearchCounts; 2],
) -> Result<(), Box<Disagreement>> {
    let [a, b] = counts;
    if a == b {
        Ok(())
    } else {
        Err(make_disagreement(questions, counts))
    }
}

/// Returns the primes of two searches.
fn primes(questions: [&Question; 2]) -> [u64; 2] {
    questions.map(|s| s.exact.field().modulus())
}

/// Returns true if two diagrams have the same nodes, edges and terminals.
#[must_use]
pub fn have_same_edges(a: &Diagram, b: &Diagram) -> bool {
    a.terminals == b.terminals
        && a.layers.len() == b.layers.len()
        && a.layers
            .iter()
            .zip(&b.layers)
            .all(|(a, b)| (a.variable, &a.edges) == (b.variable, &b.edges))
}
