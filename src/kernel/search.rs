//! Every redesign at once: the span diagram, exact counts on it, the best variants in order, and a brute-force twin.
//!
//! A *variant* chooses one option at each joint. A diagram node is what a partly chosen mechanism looks like to the
//! joints not chosen yet: what the choices add to the motions of the present joints, in the space dual to its self-stresses and
//! within what the joints to come still reach, plus the redundancy spent so far. Different choices with the same node have the
//! same futures, so a space of 10^10 variants folds into some hundred nodes and is counted without visiting any variant. With a
//! searched state a node is the space of motions of the links that still have joints to come.

pub mod answer;
pub mod build;
pub mod check;
pub mod diagram;
pub mod numeric;
pub(crate) mod order;
pub mod question;
mod reduce;
#[doc(hidden)]
pub mod testing;

use crate::geom::exact::{ExactError, ExactField};
use crate::model::mechanism::Mechanism;
use crate::search::answer::counts::{self, Counts};
use crate::search::answer::ideas::{self, Idea, IdeaBasis};
use crate::search::answer::k_best::Assignment;
use crate::search::answer::least_freedoms::{self, Less};
use crate::search::answer::variants_in_order;
use crate::search::build::Diagrams;
use crate::search::build::orders::Orders;
use crate::search::diagram::{Diagram, Progress};
use crate::search::numeric::at_tolerance::{self, AtTolerance};
use crate::search::question::Question;
use crate::search::question::conditions::{Conditions, SearchError};
use crate::search::question::rounded_rank::Digits;
use num_bigint::BigUint;
use std::ops::Deref;
use std::sync::Arc;

/// A search: a question made ready, the diagrams that answer it, and what is read off them.
#[derive(Debug)]
pub struct Search {
    question: Question,
}

/// What is asked can be looked at wherever the search is.
impl Deref for Search {
    type Target = Question;

    fn deref(&self) -> &Question {
        &self.question
    }
}

impl Search {
    /// Makes a search ready; a mechanism given by reference is copied.
    ///
    /// # Errors
    /// Where the geometry has no exact image, or symmetry is asked of an unsymmetric file.
    pub fn new(
        exact: ExactField,
        mechanism: impl Into<Arc<Mechanism>>,
        conditions: Conditions,
    ) -> Result<Search, SearchError> {
        let question = Question::new(exact, mechanism, conditions)?;
        Ok(Search { question })
    }

    /// The orders in which both diagrams take the variables; a twin over another prime may be given them.
    #[must_use]
    pub fn orders(&self) -> Orders {
        build::orders::orders(self)
    }

    /// Builds the diagrams of the determinate and of the admissible variants.
    pub fn build(
        &self,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagrams {
        build::build(self, cancelled, progress)
    }

    /// The same in given orders.
    pub fn build_in(
        &self,
        orders: &Orders,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagrams {
        build::build_in(self, orders, cancelled, progress)
    }

    /// Whether all [minimal variants](Self::minimal_variants) of another search are determinate here; `None` where that is not told
    /// without diagrams.
    #[must_use]
    pub fn has_all(&self, known: &Diagram) -> Option<bool> {
        build::known_variants::has_all(self, known)
    }

    /// Counts the variants of a diagram; `filter` applies the conditions on mobility and changes too.
    #[must_use]
    pub fn counts(&self, diagram: &Diagram, filter: bool) -> Counts {
        counts::counts(self, diagram, filter)
    }

    /// The admissible variants, cheapest first; `top` of them at most.
    pub fn cheapest<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        top: usize,
    ) -> impl Iterator<Item = Assignment> + 'a {
        variants_in_order::cheapest(self, diagrams, top)
    }

    /// Draws admissible variants without end, each with the same chance.
    pub fn sample<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        seed: u64,
    ) -> impl Iterator<Item = Assignment> + 'a {
        variants_in_order::sample(self, diagrams, seed)
    }

    /// Judges variants by singular values instead, where exact arithmetic does not have the mechanism that is meant: `list` of the
    /// cheapest, and a sample drawn from `seed`, where there are too many to look at each.
    ///
    /// # Errors
    /// Where a coordinate has no value.
    pub fn at_tolerance(
        &mut self,
        digits: Digits,
        list: usize,
        seed: u64,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<AtTolerance, ExactError> {
        at_tolerance::at_tolerance(&mut self.question, digits, list, seed, cancelled)
    }

    /// How many admissible variants are minimal: no other has part of their freedoms. `None` where that is not counted.
    #[must_use]
    pub fn minimal(&self, diagrams: &Diagrams) -> Option<BigUint> {
        least_freedoms::count(self, diagrams)
    }

    /// The diagram of those minimal ones; `None` where what is admissible is not all known, or where it takes too many nodes.
    #[must_use]
    pub fn minimal_variants(&self, diagrams: &Diagrams) -> Option<Diagram> {
        least_freedoms::diagram(self, diagrams, Less::Freedoms)
    }

    /// The admissible variants that ideas are made of: those without another that has part of their freedoms and costs no more; all
    /// where these are not known.
    #[must_use]
    pub fn idea_variants(&self, diagrams: &Diagrams) -> Diagram {
        ideas::idea_variants(self, diagrams).into_owned()
    }

    /// The first ideas, each of all minimal variants that give the same freedoms to the same contours; `top` of them at most.
    pub fn ideas(&self, diagrams: &Diagrams, top: usize) -> Vec<Idea> {
        ideas::ideas(self, diagrams, top)
    }

    /// What they depend on besides variants and costs: of another search that has the same variants at the same costs they are the same
    /// where this is.
    #[must_use]
    pub fn idea_basis(&self) -> IdeaBasis {
        IdeaBasis::of(self)
    }

    /// The same among those that [ideas are made of](Self::idea_variants), of this search's own basis.
    pub fn ideas_among(&self, basis: &IdeaBasis, variants: &Diagram, top: usize) -> Vec<Idea> {
        ideas::ideas_in_steps(self, basis, variants, top, &mut 0)
    }
}
