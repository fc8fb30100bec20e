//! The admissible variants of a finished diagram: the cheapest in order, or some at random.

use crate::search::best::{self, Assignment, Cheapest};
use crate::search::building::Diagrams;
use crate::search::conditions::{Search, Symmetry};
use crate::search::diagram::Diagram;
use crate::search::tally::{Key, Kinds, Tally};
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
        let rank = |k: Key| (self.mobility(k), k.changes());
        let wanted = |k: Key| self.wanted(k);
        if self.fits() {
            Box::new(Cheapest::<u128>::new(
                diagram,
                &self.steps,
                top,
                wanted,
                rank,
            ))
        } else {
            Box::new(Cheapest::<BigUint>::new(
                diagram,
                &self.steps,
                top,
                wanted,
                rank,
            ))
        }
    }

    /// Draws admissible variants, each with the same chance.
    #[must_use]
    pub fn sample(&self, diagrams: &Diagrams, count: usize, seed: u64) -> Vec<Assignment> {
        let kinds = Kinds {
            freedoms: self.conditions.max_mobility.is_some(),
            changes: self.conditions.max_changes.is_some(),
            cost: false,
        };
        let keys = self.steps.only(kinds);
        let diagram = &diagrams.admissible;
        let wanted = |k: Key| self.wanted(k);
        if self.fits() {
            let tally: Tally<u128> = Tally::new(diagram, &keys, None);
            best::sample(diagram, &self.steps, &keys, &tally, count, seed, wanted)
        } else {
            let tally: Tally<BigUint> = Tally::new(diagram, &keys, None);
            best::sample(diagram, &self.steps, &keys, &tally, count, seed, wanted)
        }
    }
}
