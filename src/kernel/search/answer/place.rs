//! The place of a variant in the order of cost, without the variants before it being made.

use crate::search::answer::count_tables::Tally;
use crate::search::answer::counts::fits_u128;
use crate::search::answer::k_best::Assignment;
use crate::search::diagram::Diagram;
use crate::search::question::Question;

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
