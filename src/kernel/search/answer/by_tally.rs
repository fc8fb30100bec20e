//! Variants drawn at random, and the place of a variant in the order of cost. Both follow from the counts of completions, so no other
//! variant has to be made.

use crate::search::answer::count::Count;
use crate::search::answer::count_tables::Tally;
use crate::search::answer::counts::{fits_u128, limited_kinds};
use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::diagram::Diagram;
use crate::search::question::Question;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigUint;
use num_traits::Zero;

/// Returns an endless sample of the variants of a diagram, each with the same probability. `filter` also applies the conditions on mobility
/// and changes. The sample is empty if it takes more than the available memory.
pub(in crate::search) fn sample_of<'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    seed: u64,
    filter: bool,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    if fits_u128(question) {
        sample_with::<u128>(question, diagram, seed, filter)
    } else {
        sample_with::<BigUint>(question, diagram, seed, filter)
    }
}

/// Walks down the diagram for each variant, guided by the counts of completions.
fn sample_with<'a, C: Count + 'a>(
    question: &'a Question,
    diagram: &'a Diagram,
    seed: u64,
    filter: bool,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    let kinds = limited_kinds(question, filter);
    let (all_steps, steps) = (&question.steps, question.steps.keep_kinds(kinds));
    let tally = Tally::<C>::new(diagram, &steps, None, question.conditions.memory / 4);
    let Some(tally) = tally else {
        return Box::new(std::iter::empty());
    };
    let totals = tally.total_counts().iter();
    let totals = totals.filter(|(k, _)| !filter || question.is_wanted(*k));
    let totals: Vec<(Key, BigUint)> = totals.map(|(k, c)| (*k, c.to_big_uint())).collect();
    let all: BigUint = totals.iter().map(|(_, c)| c).sum();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let draw = move || {
        if all.is_zero() {
            return None;
        }
        let mut ticket = random_below(&mut random, &all);
        let mut key = totals[0].0;
        for (k, c) in &totals {
            if ticket < *c {
                key = *k;
                break;
            }
            ticket -= c;
        }
        let mut choices = vec![0; all_steps.keys.len()];
        let (mut node, mut whole) = (0, 0u128);
        for (l, layer) in diagram.layers.iter().enumerate() {
            for choice in 0..layer.choices {
                let followed = tally.follow_choice(diagram, &steps, (l, node), choice, key);
                let Some((to, rest, count)) = followed else {
                    continue;
                };
                let size = count.to_big_uint();
                if ticket < size {
                    choices[layer.variable] = choice;
                    whole += all_steps.keys[layer.variable][choice].0;
                    (node, key) = (to, rest);
                    break;
                }
                ticket -= size;
            }
        }
        whole += all_steps.redundancy_key(diagram.terminals[node as usize]).0;
        Some(Assignment {
            choices,
            key: Key(whole),
        })
    };
    Box::new(std::iter::from_fn(draw))
}

/// Returns a number below `n`, each with the same chance.
fn random_below(random: &mut ChaCha8Rng, n: &BigUint) -> BigUint {
    let bits = n.bits();
    let mut bytes = vec![0u8; usize::try_from(bits.div_ceil(8)).unwrap_or(0)];
    loop {
        random.fill_bytes(&mut bytes);
        let x = BigUint::from_bytes_le(&bytes) >> (bytes.len() as u64 * 8 - bits);
        if x < *n {
            return x;
        }
    }
}

/// What tells places in the order of cost of a diagram's variants.
#[derive(Debug)]
pub struct Places<'d> {
    question: &'d Question,
    diagram: &'d Diagram,
    tally: Tally<u128>,
}

impl<'d> Places<'d> {
    /// Prepares a diagram. Returns `None` if its tables take more than `bytes`, or if its variants are too many to number.
    ///
    /// # Complexity
    /// O(edges · kinds of completions).
    #[must_use]
    pub fn new(question: &'d Question, diagram: &'d Diagram, bytes: usize) -> Option<Places<'d>> {
        let tally =
            fits_u128(question).then(|| Tally::new(diagram, &question.steps, None, bytes))??;
        Some(Places {
            question,
            diagram,
            tally,
        })
    }

    /// Returns the place of a variant of the diagram, from 1.
    ///
    /// # Complexity
    /// O(kinds of variants + variables · choices).
    #[must_use]
    pub fn place_of(&self, v: &Assignment) -> u128 {
        let own = self.question.sort_rank(v.key);
        let earlier = self.tally.total_counts().iter();
        let earlier = earlier
            .filter(|(k, _)| self.question.is_wanted(*k) && self.question.sort_rank(*k) < own);
        let mut place = 1 + earlier.map(|(_, n)| n).sum::<u128>();
        let (mut node, mut rest) = (0, v.key);
        let steps = &self.question.steps;
        for (l, layer) in self.diagram.layers.iter().enumerate() {
            for choice in 0..layer.choices {
                let from = (l, node);
                let followed = self
                    .tally
                    .follow_choice(self.diagram, steps, from, choice, rest);
                let Some((to, left, count)) = followed else {
                    continue;
                };
                if choice == v.choices[layer.variable] {
                    (node, rest) = (to, left);
                    break;
                }
                place += count;
            }
        }
        place
    }
}
