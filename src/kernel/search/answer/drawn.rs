//! Variants of a diagram drawn at random.

use crate::search::answer::count::Count;
use crate::search::answer::count_tables::Tally;
use crate::search::answer::counts::{fits, limited};
use crate::search::answer::k_best::{Assignment, Sample};
use crate::search::answer::keys::{Key, Kinds};
use crate::search::diagram::Diagram;
use crate::search::question::Question;
use num_bigint::BigUint;

/// Draws variants of a diagram without end, each with the same chance; `filter` applies the conditions on mobility and changes, too.
/// None where what it takes to draw is more than the memory there is.
pub(in crate::search) fn sample_of<'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    seed: u64,
    filter: bool,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    if fits(question) {
        sample_with::<u128>(question, diagram, seed, filter)
    } else {
        sample_with::<BigUint>(question, diagram, seed, filter)
    }
}

fn sample_with<'a, C: Count + 'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    seed: u64,
    filter: bool,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    let kinds = if filter {
        limited(question)
    } else {
        Kinds::default()
    };
    let keys = question.steps.only(kinds);
    let tally = Tally::<C>::new(diagram, &keys, None, question.conditions.memory / 4);
    let wanted = |k: Key| !filter || question.wanted(k);
    let drawn = tally.map(|t| Sample::new(diagram, &question.steps, keys, t, seed, wanted));
    Box::new(drawn.into_iter().flatten())
}
