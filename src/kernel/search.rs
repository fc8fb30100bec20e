//! Finds every redesign at once: the span diagram, exact counts on it, the best variants in order, and a brute-force
//! reference implementation.
//!
//! A *variant* chooses one option at each joint. A diagram node is the state of a partly chosen mechanism as seen by
//! the joints not chosen yet. It consists of the vectors that the choices add to the motions of the original joints,
//! and the redundancy so far. The vectors are in the space dual to the self-stresses, restricted to what the remaining
//! joints can still reach. Different choices with the same node have the same completions. So a space of 10^10 variants
//! reduces to a few hundred nodes and is counted without visiting any variant. A searched state, drives and poses near the
//! drawn one are further coordinates of the same space.

pub mod answer;
pub mod at_tolerance;
pub mod build;
pub mod check;
pub mod diagram;
pub(crate) mod order;
pub mod question;
mod reduce;
#[doc(hidden)]
pub mod testing;

use crate::geom::exact::ExactError;
use crate::search::answer::counts::{self, Counts};
use crate::search::answer::ideas::least_freedoms::{self, Less};
use crate::search::answer::ideas::{self, Idea, IdeaBasis};
use crate::search::answer::k_best::Assignment;
use crate::search::answer::variants_in_order;
use crate::search::at_tolerance::AtTolerance;
use crate::search::build::Diagrams;
use crate::search::build::orders::Orders;
use crate::search::diagram::{Diagram, Progress};
use crate::search::question::Question;
use crate::search::question::rounded_rank::Digits;
use num_bigint::BigUint;

/// A search is a prepared question: this module has the methods that build its diagrams and read them.
pub use crate::search::question::Question as Search;

impl Question {
    /// Returns the variable orders of both diagrams. A reference search over another prime may use them.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let known = search.build_in(&search.variable_orders(), &|| false, &mut |_| {});
    /// assert!(search.has_all(&known.determinate));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn variable_orders(&self) -> Orders {
        build::orders::variable_orders(self)
    }

    /// Builds the diagrams of the determinate and of the admissible variants.
    pub fn build_diagrams(
        &self,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagrams {
        build::build_diagrams(self, cancelled, progress)
    }

    /// Builds the diagrams in given orders.
    pub fn build_in(
        &self,
        orders: &Orders,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagrams {
        build::build_in(self, orders, cancelled, progress)
    }

    /// Returns whether all variants of another search's diagram are determinate here.
    #[must_use]
    pub fn has_all(&self, known: &Diagram) -> bool {
        build::known_variants::has_all(self, known)
    }

    /// Returns the counts of the variants of a diagram; `filter` also applies the conditions on mobility and changes.
    #[must_use]
    pub fn count_variants(&self, diagram: &Diagram, filter: bool) -> Counts {
        counts::count_by_kind(self, diagram, filter)
    }

    /// Returns at most `top` admissible variants, cheapest first.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(&|| false, &mut |_| {});
    /// let found: Vec<_> = search.cheapest_variants(&diagrams, 5).collect();
    /// assert!(found.windows(2).all(|w| w[0].key.cost() <= w[1].key.cost()));
    /// assert!(found.iter().all(|v| v.key.internal() == 0)); // σ = 0
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn cheapest_variants<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        top: usize,
    ) -> impl Iterator<Item = Assignment> + 'a {
        variants_in_order::cheapest_variants(self, diagrams, top)
    }

    /// Returns an endless sample of admissible variants, each with the same probability.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(&|| false, &mut |_| {});
    /// let drawn = || search.sample_variants(&diagrams, 7).take(3).collect::<Vec<_>>();
    /// assert_eq!(drawn(), drawn()); // The seed decides.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sample_variants<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        seed: u64,
    ) -> impl Iterator<Item = Assignment> + 'a {
        variants_in_order::sample_variants(self, diagrams, seed)
    }

    /// Tests variants by singular values, if exact arithmetic does not have the intended mechanism. If there are too many to
    /// test each, it tests the `list` cheapest and a sample drawn from `seed`.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub fn at_tolerance(
        &mut self,
        digits: Digits,
        list: usize,
        seed: u64,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<AtTolerance, ExactError> {
        at_tolerance::at_tolerance(self, digits, list, seed, cancelled)
    }

    /// Returns the number of minimal admissible variants: no other variant has only a part of their freedoms. Returns
    /// `None` if that is not counted.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(&|| false, &mut |_| {});
    /// assert_eq!(search.count_variants(&diagrams.admissible, true).to_string(), "14");
    /// assert_eq!(search.count_minimal(&diagrams), Some(12u32.into()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn count_minimal(&self, diagrams: &Diagrams) -> Option<BigUint> {
        least_freedoms::count_minimal(self, diagrams)
    }

    /// Returns the diagram of the minimal variants. Returns `None` if not all admissible variants are known, or if it
    /// takes too many nodes.
    #[must_use]
    pub fn minimal_variants(&self, diagrams: &Diagrams) -> Option<Diagram> {
        least_freedoms::minimal_diagram(self, diagrams, Less::Freedoms)
    }

    /// Returns the admissible variants that ideas consist of: those for which no other has only a part of their
    /// freedoms and costs no more. Returns all if these are unknown.
    #[must_use]
    pub fn idea_variants(&self, diagrams: &Diagrams) -> Diagram {
        ideas::idea_variants(self, diagrams).into_owned()
    }

    /// Returns at most `top` first ideas, each of all minimal variants that give the same freedoms to the same
    /// contours.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(&|| false, &mut |_| {});
    /// let ideas = search.list_ideas(&diagrams, 3);
    /// // The first adds the three freedoms that remove σ = 3, and may add them in six ways.
    /// assert_eq!((ideas[0].first.key.freedoms(), ideas[0].variants.to_string().as_str()), (4 + 3, "6"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn list_ideas(&self, diagrams: &Diagrams, top: usize) -> Vec<Idea> {
        ideas::list_ideas(self, diagrams, top)
    }

    /// Returns the basis of the ideas in addition to variants and costs. Two searches with the same variants, costs and
    /// basis have the same ideas.
    #[must_use]
    pub fn idea_basis(&self) -> IdeaBasis {
        IdeaBasis::of_question(self)
    }

    /// Returns the ideas among the variants that [ideas consist of](Self::idea_variants), with this search's basis.
    pub fn ideas_among(&self, basis: &IdeaBasis, variants: &Diagram, top: usize) -> Vec<Idea> {
        ideas::ideas_in_steps(self, basis, variants, top, &mut 0)
    }
}
