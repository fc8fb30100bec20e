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
pub mod check;
pub mod diagram;
pub(crate) mod order;
pub mod question;
mod reduce;
pub mod solve;
#[doc(hidden)]
pub mod testing;

use crate::search::diagram::{Control, Diagram};
use crate::search::question::Question;
use crate::search::solve::Diagrams;
use crate::search::solve::orders::Orders;

/// A search is a prepared question; this module has the methods that build its diagrams, and [`answer`] those that read them.
pub use crate::search::question::Question as Search;

impl Question {
    /// Returns the variable orders of both diagrams. A reference search over another prime may use them.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let known = search.build_in(&search.variable_orders(), Control::NONE);
    /// assert!(search.has_all(&known.determinate));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn variable_orders(&self) -> Orders {
        solve::orders::variable_orders(self)
    }

    /// Builds the diagrams of the determinate and of the admissible variants.
    pub fn build_diagrams(&self, control: Control<'_>) -> Diagrams {
        solve::build_diagrams(self, control)
    }

    /// Builds the diagrams in given orders.
    pub fn build_in(&self, orders: &Orders, control: Control<'_>) -> Diagrams {
        solve::build_in(self, orders, control)
    }

    /// Returns whether all variants of another search's diagram are determinate here.
    #[must_use]
    pub fn has_all(&self, known: &Diagram) -> bool {
        solve::known_variants::has_all(self, known)
    }
}
