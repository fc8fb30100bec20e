//! The variants of an outcome, one by one.

use crate::model::mechanism::Mechanism;
use crate::score::outcome::Outcome;
use crate::score::outcome::variant::Variant;
use crate::score::request::{Check, List, Request, RequestError};
use crate::score::run::ShouldCancel;
use crate::search::answer::ideas;
use crate::search::answer::ideas::Idea;
use crate::search::answer::k_best::Assignment;
use crate::search::at_tolerance::AtTolerance;
use crate::search::check::other_poses::Stroke;
use crate::search::check::singular_values;
use crate::search::check::singular_values::{Certified, Summary};
use crate::search::diagram::Stop;
use crate::search::question::conditions::Symmetry;
use itertools::Itertools;
use num_traits::Zero;
use std::fmt;

impl Request {
    /// Returns how many of the cheapest variants the requested list needs; 0 if it needs all, or none.
    pub(in crate::score) fn cheapest_needed(
        &self,
        mechanism: &Mechanism,
    ) -> Result<usize, RequestError> {
        let List::Top(top) = self.list else {
            return Ok(0);
        };
        let looked = match self.asked_ranking(mechanism)? {
            Some(_) => self.cheapest_scored().saturating_add(1),
            None => top,
        };
        // Of a variant and its images one is kept.
        let images = match self.symmetry {
            // Images that the file does not name are looked for later, and are two or three.
            Symmetry::OnePerOrbit => mechanism.search.symmetry_order().max(3),
            Symmetry::All | Symmetry::SymmetricOnly => 1,
        };
        Ok(looked.saturating_mul(images))
    }
}

impl Outcome {
    /// The variants asked for, one by one: the best in order, all, or a sample. No more than a thousand are held at a time,
    /// and second opinions are had in parallel.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
    /// let costs: Vec<f64> = outcome.variants().map(|v| v.cost()).collect();
    /// assert_eq!((costs.len(), costs[0]), (10, 11.5));
    /// assert!(costs.is_sorted());
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn variants(&self) -> Variants<'_> {
        self.variants_unless(&|| false)
    }

    /// The same until `cancelled`.
    pub fn variants_unless<'o>(&'o self, cancelled: ShouldCancel<'o>) -> Variants<'o> {
        let request = &self.request;
        self.make_list(request.list, request.distinct, request.seed, cancelled)
    }

    /// As many ideas as variants were asked for, each as its first variant, until `cancelled`.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// let ideas: Vec<_> = outcome.ideas_unless(&|| false).collect();
    /// assert_eq!((ideas.len(), ideas[0].name().as_str()), (3, "idea 1")); // Of 14 variants.
    /// assert!(ideas[0].to_string().ends_with("1-2 -> cylindrical; 2-3 -> spherical"));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn ideas_unless<'o>(&'o self, cancelled: ShouldCancel<'o>) -> Variants<'o> {
        self.make_list(self.request.list, true, self.request.seed, cancelled)
    }

    /// Returns another list of the same variants, until `cancelled`: all of them, or a sample by another seed. The best by a ranking need
    /// another search, and so do more of the best than a search without counts was asked for.
    ///
    /// # Examples
    /// ```
    /// use ozols::score::request::List;
    /// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
    /// let drawn = |seed| -> Vec<f64> {
    ///     outcome.list_unless(List::Sample(3), seed, &|| false).map(|v| v.cost()).collect()
    /// };
    /// assert_eq!(drawn(1), drawn(1)); // The seed decides.
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn list_unless<'o>(
        &'o self,
        list: List,
        seed: u64,
        cancelled: ShouldCancel<'o>,
    ) -> Variants<'o> {
        self.make_list(list, self.request.distinct, seed, cancelled)
    }

    /// A list, of ideas or of all variants.
    fn make_list<'o>(
        &'o self,
        list: List,
        distinct: bool,
        seed: u64,
        cancelled: ShouldCancel<'o>,
    ) -> Variants<'o> {
        let ListSource { variants, ideas } = match &self.numeric {
            Some(found) => self.by_values(found, list, distinct, seed),
            None => self.by_diagrams(list, distinct, seed),
        };
        // What is proven is a list of all variants; of ideas a diagram cut down may lack the first ones.
        let by_cost = match list {
            _ if self.numeric.is_some() => false,
            List::Top(_) | List::Nothing => self.ranking.is_none() && !distinct,
            List::All => true,
            List::Sample(_) => false,
        };
        let summary = Summary {
            proven: (by_cost && !self.is_exact()).then_some(0),
            ..Summary::default()
        };
        Variants {
            outcome: self,
            list,
            cancelled,
            source: variants,
            opinions: self.request.check == Check::Full,
            stroke: self.stroke.as_ref(),
            ready: Vec::new().into_iter(),
            ideas,
            distinct,
            room: longest_list(list),
            summary,
            interrupted: false,
            short: false,
        }
    }

    /// A list of what singular values found.
    fn by_values<'o>(
        &'o self,
        found: &'o AtTolerance,
        list: List,
        distinct: bool,
        seed: u64,
    ) -> ListSource<'o> {
        let unranked = |v: Assignment| (v, None);
        let sure = found.list_variants();
        match list {
            List::Nothing => ListSource::of_variants(std::iter::empty()),
            List::Top(k) if distinct => {
                let ideas = ideas::ideas_among(&self.search, sure, k);
                let places = vec![None; ideas.len()];
                ListSource::of_ideas(ideas, places)
            }
            List::Top(_) | List::All => ListSource::of_variants(sure.map(unranked)),
            List::Sample(n) => {
                let drawn = found.draw_variants(seed);
                ListSource::of_variants(drawn.take(n).map(unranked))
            }
        }
    }

    /// Returns a list from the diagrams, empty if there are none.
    fn by_diagrams(&self, list: List, distinct: bool, seed: u64) -> ListSource<'_> {
        let unranked = |v: Assignment| (v, None);
        let Some(d) = &self.diagrams else {
            return ListSource::of_variants(std::iter::empty());
        };
        match (list, &self.ranking) {
            (List::Nothing, _) => ListSource::of_variants(std::iter::empty()),
            (List::Top(k), Some(ranked)) if distinct => {
                let list = ranked.list.iter().map(|r| &r.variant);
                let first = ideas::first_of_each(&self.search, list, d).into_iter();
                let first = first.map(|(at, idea)| (Some(at), idea)).take(k);
                let (places, ideas) = first.unzip();
                ListSource::of_ideas(ideas, places)
            }
            (List::Top(k), None) if distinct => {
                let ideas = self.search.list_ideas(d, k);
                let places = vec![None; ideas.len()];
                ListSource::of_ideas(ideas, places)
            }
            (List::Sample(n), _) => {
                let drawn = self.search.sample_variants(d, seed);
                ListSource::of_variants(drawn.take(n).map(unranked))
            }
            (List::Top(_), Some(ranked)) => {
                let list = ranked.list.iter().enumerate();
                ListSource::of_variants(list.map(|(place, r)| (r.variant.clone(), Some(place))))
            }
            (List::Top(_) | List::All, _) => ListSource::of_variants(
                self.search
                    .cheapest_variants(d, longest_list(list))
                    .map(unranked),
            ),
        }
    }
}

/// Returns the largest length of a list.
fn longest_list(list: List) -> usize {
    match list {
        List::Top(k) => k,
        List::All | List::Sample(_) => usize::MAX / 4,
        List::Nothing => 0,
    }
}

/// The source of a list.
struct ListSource<'o> {
    /// Variants, with their places in the ranking if there is one.
    variants: Box<dyn Iterator<Item = (Assignment, Option<usize>)> + 'o>,
    /// The idea of each, if only the first variant of each idea is listed.
    ideas: Vec<Idea>,
}

impl<'o> ListSource<'o> {
    fn of_variants(
        variants: impl Iterator<Item = (Assignment, Option<usize>)> + 'o,
    ) -> ListSource<'o> {
        ListSource {
            variants: Box::new(variants),
            ideas: Vec::new(),
        }
    }

    /// Ideas, each as its first variant, with their places.
    fn of_ideas(ideas: Vec<Idea>, places: Vec<Option<usize>>) -> ListSource<'o> {
        let firsts = ideas.iter().map(|i| i.first.clone()).collect_vec();
        ListSource {
            variants: Box::new(firsts.into_iter().zip(places)),
            ideas,
        }
    }
}

/// The variants of an outcome, one by one.
pub struct Variants<'o> {
    outcome: &'o Outcome,
    list: List,
    cancelled: ShouldCancel<'o>,
    /// Variants, with their places in the ranking if there is one.
    source: Box<dyn Iterator<Item = (Assignment, Option<usize>)> + 'o>,
    /// Whether second opinions are wanted of those to come.
    opinions: bool,
    /// The poses in which the next ones are examined.
    stroke: Option<&'o Stroke>,
    /// Examined, and not given yet.
    ready: std::vec::IntoIter<(Certified, Option<usize>)>,
    /// The idea of each, if only the first variant of each idea is listed.
    ideas: Vec<Idea>,
    distinct: bool,
    /// How many more may be given.
    room: usize,
    summary: Summary,
    interrupted: bool,
    short: bool,
}

impl fmt::Debug for Variants<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Variants")
            .field("summary", &self.summary)
            .finish_non_exhaustive()
    }
}

impl Variants<'_> {
    /// What second opinions and other poses say of those given so far.
    pub fn summary(&self) -> Summary {
        self.summary
    }

    /// Whether the giving was cancelled.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    /// Why the giving ended early, so far as it goes: it or the ranking was interrupted, or it would have taken more than the
    /// memory there is.
    pub fn cut_short(&self) -> Option<Stop> {
        let ranking = self.outcome.ranking.as_ref();
        if self.interrupted || ranking.is_some_and(|r| r.interrupted) {
            return Some(Stop::Interrupted);
        }
        self.short.then_some(Stop::Memory)
    }

    /// Why this is not all that was asked for: the giving, or else the search.
    pub fn stop(&self) -> Stop {
        self.cut_short().unwrap_or(self.outcome.stop)
    }

    /// Returns whether fewer came than there are, although none was omitted on purpose.
    fn is_short(&self) -> bool {
        let (o, given) = (self.outcome, self.summary.given);
        let due = match self.list {
            List::Sample(n) if !o.listed_counts().total.is_zero() => n.into(),
            List::Top(k) if o.ranking.is_none() => o.listed_counts().total.clone().min(k.into()),
            List::All => o.listed_counts().total.clone(),
            _ => return false,
        };
        // Brute force gives none, and orbits of a list cut short are not counted one by one.
        let counted =
            o.diagrams.is_some() && (o.is_counted() || o.request.symmetry != Symmetry::OnePerOrbit);
        counted && !self.distinct && due > given.into()
    }

    /// Returns the idea of a variant, if only the first variant of each idea is listed.
    fn idea_of(&self, of: &Certified) -> Option<Idea> {
        self.ideas.iter().find(|i| i.first == of.variant).cloned()
    }

    /// The next with its opinions: variants are gathered first, so that they are analysed in parallel.
    fn next_certified(&mut self) -> Option<(Certified, Option<usize>)> {
        if let Some(next) = self.ready.next() {
            return Some(next);
        }
        if !self.opinions && self.stroke.is_none() {
            let (variant, place) = self.source.next()?;
            return Some((Certified::without_opinion(variant), place));
        }
        let search = &self.outcome.search;
        let size = singular_values::affordable_count(search);
        let (block, places): (Vec<_>, Vec<_>) = self.source.by_ref().take(size).unzip();
        let certified = singular_values::certify_variants(
            search,
            block,
            self.opinions,
            self.stroke,
            self.cancelled,
        );
        self.ready = certified.into_iter().zip(places).collect_vec().into_iter();
        (self.opinions, self.stroke) = (false, None);
        self.ready.next()
    }
}

impl<'o> Iterator for Variants<'o> {
    type Item = Variant<'o>;

    fn next(&mut self) -> Option<Variant<'o>> {
        if self.room > 0 {
            if (self.cancelled)() {
                self.interrupted = true;
                return None;
            }
            let Some((certified, place)) = self.next_certified() else {
                self.interrupted = (self.cancelled)();
                self.short = self.is_short();
                return None;
            };
            self.room -= 1;
            self.summary.add_certified(&certified);
            let cost = self
                .outcome
                .search
                .steps
                .cost_in_milli(certified.variant.key.cost());
            if let Some(n) = &mut self.summary.proven
                && self
                    .outcome
                    .known_up_to()
                    .is_some_and(|known| cost <= known)
            {
                *n += 1;
            }
            return Some(Variant {
                outcome: self.outcome,
                position: self.summary.given,
                idea: self.idea_of(&certified),
                certified,
                place,
            });
        }
        None
    }
}
