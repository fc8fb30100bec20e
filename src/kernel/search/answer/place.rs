//! The place of a variant in the order of cost, without the variants before it being made.

use crate::search::answer::count_tables::Tally;
use crate::search::answer::counts::fits;
use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::diagram::{DEAD, Diagram};
use crate::search::question::Question;

/// What tells places in the order of cost of a diagram's variants.
#[derive(Debug)]
pub struct Places<'d> {
    question: &'d Question,
    diagram: &'d Diagram,
    tally: Tally<u128>,
}

impl<'d> Places<'d> {
    /// Of a diagram; `None` where its tables take more than some bytes, or its variants are too many to number.
    ///
    /// # Complexity
    /// O(edges · kinds of completions).
    #[must_use]
    pub fn new(question: &'d Question, diagram: &'d Diagram, bytes: usize) -> Option<Places<'d>> {
        let tally = fits(question).then(|| Tally::new(diagram, &question.steps, None, bytes))??;
        Some(Places {
            question,
            diagram,
            tally,
        })
    }

    /// The place of a variant of the diagram, from 1.
    ///
    /// # Complexity
    /// O(kinds of variants + variables · choices).
    #[must_use]
    pub fn of(&self, v: &Assignment) -> u128 {
        let own = self.question.rank(v.key);
        let earlier = self.tally.totals().iter();
        let earlier =
            earlier.filter(|(k, _)| self.question.wanted(*k) && self.question.rank(*k) < own);
        let mut place = 1 + earlier.map(|(_, n)| n).sum::<u128>();
        let (mut node, mut rest) = (0, v.key);
        for (l, layer) in self.diagram.layers.iter().enumerate() {
            let chosen = v.choices[layer.variable];
            for (choice, key) in self.question.steps.keys[layer.variable].iter().enumerate() {
                let to = layer.edges[node * layer.choices + choice];
                let left = rest.0.checked_sub(key.0).map(Key);
                let (Some(left), true) = (left, to != DEAD) else {
                    continue;
                };
                if choice == chosen {
                    (node, rest) = (to as usize, left);
                    break;
                }
                let table = &self.tally.tables[l + 1][to as usize];
                if let Ok(at) = table.binary_search_by_key(&left, |(k, _)| *k) {
                    place += table[at].1;
                }
            }
        }
        place
    }
}
