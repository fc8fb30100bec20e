//! The admissible variants of a finished diagram: the cheapest in order, or some at random.

use crate::search::answer::by_tally::sample_of;
use crate::search::answer::k_best::{Assignment, Cheapest, Reach, enter_all};
use crate::search::answer::keys::Key;
use crate::search::answer::proven_cheapest::UpTo;
use crate::search::diagram::Diagram;
use crate::search::question::Question;
use crate::search::question::conditions::Symmetry;
use crate::search::solve::Diagrams;

impl Question {
    /// Returns at most `top` admissible variants, cheapest first, then by W, then by changes, then in the order of the diagram's variables.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(Control::NONE);
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
        // Of two or three images the first is kept, so that so many times more always suffice.
        let enough = match self.conditions.symmetry {
            Symmetry::OnePerOrbit => top.saturating_mul(self.mechanism.search.symmetry_order()),
            Symmetry::All | Symmetry::SymmetricOnly => top,
        };
        in_order(self, diagrams, enough).take(top)
    }

    /// Returns an endless sample of admissible variants or orbits, each with the same probability. The sample is empty if it takes more
    /// than the available memory.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(Control::NONE);
    /// let drawn = || search.sample_variants(&diagrams, 7).take(3).collect::<Vec<_>>();
    /// assert_eq!(drawn(), drawn()); // The seed decides.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sample_variants<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        seed: u64,
    ) -> impl Iterator<Item = Assignment> + 'a {
        let diagram = diagrams.listed_diagram();
        // Each orbit has one variant that comes first, and so the same chance.
        let all = sample_of(self, diagram, seed, true);
        all.filter(move |v| is_first_image(self, diagram, v))
    }
}

/// Returns the variants up to the cost below which all are known, then the dearer ones that happen to be known. Returns the
/// requested ones of `top` variants.
fn in_order<'a>(
    question: &'a Question,
    diagrams: &'a Diagrams,
    top: usize,
) -> Box<dyn Iterator<Item = Assignment> + 'a> {
    let steps = &question.steps;
    let between = move |diagram: &'a Diagram, least: i64, most: i64| {
        let reach = Reach::Variants(top, steps.steps_above(most));
        let wanted = |k: Key| {
            question.is_wanted(k) && (least..=most).contains(&steps.cost_in_milli(k.cost()))
        };
        let all = Cheapest::new(question, diagram, steps, reach, &wanted, enter_all());
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
