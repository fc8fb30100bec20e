//! The admissible variants of a finished diagram: the cheapest in order, or some at random.

use crate::search::best::{Assignment, Cheapest, Enter, Sample};
use crate::search::building::Diagrams;
use crate::search::conditions::{Search, Symmetry};
use crate::search::diagram::Diagram;
use crate::search::tally::{Count, Key, Tally};
use num_bigint::BigUint;

impl Search {
    /// The admissible variants, cheapest first, then by W, then by changes, then in the order of the diagram's variables;
    /// `top` of them at most.
    pub fn cheapest<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        top: usize,
    ) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        if self.conditions.symmetry != Symmetry::OnePerOrbit {
            return self.in_order(&diagrams.admissible, top);
        }
        // At most every other variant is dropped, so twice as many always suffice.
        let all = self.in_order(&diagrams.admissible, top.saturating_mul(2));
        let first_of_orbit = |v: &Assignment| self.mirrored(&v.choices) >= v.choices;
        Box::new(all.filter(first_of_orbit).take(top))
    }

    fn in_order<'a>(
        &'a self,
        diagram: &'a Diagram,
        top: usize,
    ) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        self.distinct(diagram, top, Box::new(|_, _, _, _| true))
    }

    /// The admissible variants of a diagram in order, but for those whose beginnings `enter` refuses.
    pub(super) fn distinct<'a>(
        &'a self,
        diagram: &'a Diagram,
        top: usize,
        enter: Enter<'a>,
    ) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        let rank = |k: Key| (self.mobility(k), k.changes());
        let wanted = |k: Key| self.wanted(k);
        if self.fits() {
            Box::new(Cheapest::<u128>::new(
                diagram,
                &self.steps,
                top,
                wanted,
                rank,
                self.conditions.memory / 4,
                enter,
            ))
        } else {
            Box::new(Cheapest::<BigUint>::new(
                diagram,
                &self.steps,
                top,
                wanted,
                rank,
                self.conditions.memory / 4,
                enter,
            ))
        }
    }

    /// Draws admissible variants without end, each with the same chance; none where what it takes to draw is more than the
    /// memory there is.
    pub fn sample<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        seed: u64,
    ) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        if self.fits() {
            self.sample_with::<u128>(&diagrams.admissible, seed)
        } else {
            self.sample_with::<BigUint>(&diagrams.admissible, seed)
        }
    }

    fn sample_with<'a, C: Count + 'a>(
        &'a self,
        diagram: &'a Diagram,
        seed: u64,
    ) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        let keys = self.steps.only(self.limited());
        let tally = Tally::<C>::new(diagram, &keys, None, self.conditions.memory / 4);
        let wanted = |k: Key| self.wanted(k);
        let drawn = tally.map(|t| Sample::new(diagram, &self.steps, (keys, t), seed, wanted));
        Box::new(drawn.into_iter().flatten())
    }
}
