//! The admissible variants of a finished diagram: the cheapest in order, or some at random.

use crate::search::answer::by_tally::sample_of;
use crate::search::answer::counts::fits_u128;
use crate::search::answer::k_best::{Assignment, Cheapest, Enter, ListLimits, Reach};
use crate::search::answer::keys::{Key, Steps};
use crate::search::answer::proven_cheapest::UpTo;
use crate::search::build::Diagrams;
use crate::search::diagram::Diagram;
use crate::search::question::Question;
use crate::search::question::conditions::Symmetry;
use num_bigint::BigUint;

/// Refuses nothing.
fn enter_all<'a>() -> Enter<'a> {
    Box::new(|_, _, _, _| true)
}

/// Returns at most `top` admissible variants, cheapest first, then by W, then by changes, then in the order of the diagram's variables.
pub(crate) fn cheapest_variants<'a>(
    question: &'a Question,
    diagrams: &'a Diagrams,
    top: usize,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    // Of two or three images the first is kept, so that so many times more always suffice.
    let enough = match question.conditions.symmetry {
        Symmetry::OnePerOrbit => top.saturating_mul(question.mechanism.search.symmetry_order()),
        Symmetry::All | Symmetry::SymmetricOnly => top,
    };
    Box::new(in_order(question, diagrams, enough).take(top))
}

/// Returns the variants up to the cost below which all are known, then the dearer ones that happen to be known. Returns the
/// requested ones of `top` variants.
fn in_order<'a>(
    question: &'a Question,
    diagrams: &'a Diagrams,
    top: usize,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    let between = move |diagram: &'a Diagram, least, most| {
        let all = variants_between(question, diagram, top, least, most, enter_all());
        all.filter(move |v| is_first_image(question, diagram, v))
    };
    let all = diagrams.listed_diagram();
    let Some(UpTo {
        diagram,
        cost_milli,
    }) = &diagrams.cheapest
    else {
        return Box::new(between(all, i64::MIN, i64::MAX));
    };
    let first = between(diagram, i64::MIN, *cost_milli);
    let dearer = std::iter::once_with(move || between(all, cost_milli.saturating_add(1), i64::MAX));
    Box::new(first.chain(dearer.flatten()))
}

/// Returns true if a variant precedes its images, which have the same properties, in the order of a diagram's variables.
/// Always true if images are not merged.
fn is_first_image(question: &Question, diagram: &Diagram, v: &Assignment) -> bool {
    if question.conditions.symmetry != Symmetry::OnePerOrbit {
        return true;
    }
    let by_layer = |choices: &Vec<usize>| -> Vec<usize> {
        diagram.layers.iter().map(|l| choices[l.variable]).collect()
    };
    let own = by_layer(&v.choices);
    let images = std::iter::successors(Some(question.image_of(&v.choices)), |c| {
        Some(question.image_of(c))
    });
    let mut others = images.take(question.mechanism.search.symmetry_order() - 1);
    others.all(|image| by_layer(&image) >= own)
}

/// Returns the admissible variants of a diagram that cost no more than `slack` above the cheapest, by other steps than the
/// question's. They come in the order and with the keys of these steps, without those whose beginnings `enter` refuses. Also
/// returns true if none cost more.
pub(in crate::search) fn variants_within<'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    steps: &'a Steps,
    slack: u64,
    enter: Enter<'a>,
) -> (Box<dyn Iterator<Item = Assignment> + 'a>, bool) {
    let wanted = |k: Key| question.is_wanted(k);
    let limits = ListLimits {
        reach: Reach::Above(slack),
        ceiling: u64::MAX,
    };
    in_steps(question, diagram, steps, limits, wanted, enter)
}

/// Returns the variants of a diagram with costs in thousandths from `least` to `most`. Omits those whose beginnings `enter`
/// refuses.
fn variants_between<'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    top: usize,
    least: i64,
    most: i64,
    enter: Enter<'a>,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    let costs = |k: Key| (least..=most).contains(&question.steps.cost_in_milli(k.cost()));
    let wanted = |k: Key| question.is_wanted(k) && costs(k);
    let limits = ListLimits {
        reach: Reach::Variants(top),
        ceiling: question.steps.steps_above(most),
    };
    in_steps(question, diagram, &question.steps, limits, wanted, enter).0
}

/// Returns at least `top` variants of a diagram in order of cost, without conditions on their keys. Returns none if memory does not
/// suffice.
pub(in crate::search) fn every_choice<'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    top: usize,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    let limits = ListLimits {
        reach: Reach::Variants(top),
        ceiling: u64::MAX,
    };
    in_steps(
        question,
        diagram,
        &question.steps,
        limits,
        |_| true,
        enter_all(),
    )
    .0
}

/// Returns the variants of a diagram whose keys pass a test, in the order of some steps. Also returns true if there are no
/// others.
fn in_steps<'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    steps: &'a Steps,
    limits: ListLimits,
    wanted: impl Fn(Key) -> bool,
    enter: Enter<'a>,
) -> (Box<dyn Iterator<Item = Assignment> + 'a>, bool) {
    let rank = |k: Key| question.sort_rank(k);
    let room = question.conditions.memory / 4;
    if fits_u128(question) {
        let all = Cheapest::<u128>::new(diagram, steps, limits, wanted, rank, room, enter);
        let is_all = all.is_all();
        (Box::new(all), is_all)
    } else {
        let all = Cheapest::<BigUint>::new(diagram, steps, limits, wanted, rank, room, enter);
        let is_all = all.is_all();
        (Box::new(all), is_all)
    }
}

/// Returns the properties of a variant of a diagram.
pub(in crate::search) fn variant_key(
    question: &Question,
    diagram: &Diagram,
    choices: &[usize],
) -> Key {
    let chosen = choices.iter().enumerate();
    let sum: u128 = chosen.map(|(v, &c)| question.steps.keys[v][c].0).sum();
    let end = diagram.end_of(choices).unwrap_or_default();
    Key(sum + question.steps.redundancy_key(end).0)
}

/// Returns an endless sample of admissible variants or orbits, each with the same probability. The sample is empty if it takes more than
/// the available memory.
pub(crate) fn sample_variants<'a>(
    question: &'a Question,
    diagrams: &'a Diagrams,
    seed: u64,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    let diagram = diagrams.listed_diagram();
    // Each orbit has one variant that comes first, and so the same chance.
    let all = sample_of(question, diagram, seed, true);
    Box::new(all.filter(move |v| is_first_image(question, diagram, v)))
}
