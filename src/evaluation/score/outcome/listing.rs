//! The variants of an outcome, one by one.

use crate::model::mechanism::Mechanism;
use crate::score::outcome::Outcome;
use crate::score::outcome::variant::Variant;
use crate::score::request::{Check, List, Request, RequestError};
use crate::score::run::ShouldCancel;
use crate::search::answer::ideas;
use crate::search::answer::ideas::Idea;
use crate::search::answer::k_best::Assignment;
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
    /// Returns the requested variants, one by one: the best in order, all, or a sample. No more than a thousand are held at
    /// a time, and second opinions are computed in parallel.
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

    /// Returns the requested variants, until `cancelled`.
    pub fn variants_unless<'o>(&'o self, cancelled: ShouldCancel<'o>) -> Variants<'o> {
        let request = &self.request;
        self.make_list(request.list, request.distinct, request.seed, cancelled)
    }

    /// Returns as many ideas as variants were requested, each as its first variant, until `cancelled`.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// let ideas: Vec<_> = outcome.ideas_unless(&|| false).collect();
    /// assert_eq!(ideas[0].name(), "idea 1");
    /// assert!(ideas.len() <= outcome.variants().count());
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

    /// Returns a list, of ideas or of all variants.
    fn make_list<'o>(
        &'o self,
        list: List,
        distinct: bool,
        seed: u64,
        cancelled: ShouldCancel<'o>,
    ) -> Variants<'o> {
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
            source: self.listed(list, distinct, seed),
            opinions: self.request.check == Check::Full,
            stroke: self.stroke.as_ref(),
            ready: Vec::new().into_iter(),
            distinct,
            room: longest_list(list),
            summary,
            interrupted: false,
            short: false,
        }
    }

    /// Returns what a list has, from the diagrams or by singular values.
    fn listed(
        &self,
        list: List,
        distinct: bool,
        seed: u64,
    ) -> Box<dyn Iterator<Item = Listed> + '_> {
        let plain = |variant| Listed {
            variant,
            place: None,
            idea: None,
        };
        let of_idea = |place, idea: Idea| Listed {
            variant: idea.first.clone(),
            place,
            idea: Some(idea),
        };
        let search = &self.search;
        if let Some(found) = &self.numeric {
            let sure = found.list_variants();
            return match list {
                List::Nothing => Box::new(std::iter::empty()),
                List::Top(k) if distinct => {
                    let ideas = ideas::ideas_among(search, sure, k).into_iter();
                    Box::new(ideas.map(move |idea| of_idea(None, idea)))
                }
                List::Top(_) | List::All => Box::new(sure.map(plain)),
                List::Sample(n) => Box::new(found.draw_variants(seed).take(n).map(plain)),
            };
        }
        let Some(d) = &self.diagrams else {
            return Box::new(std::iter::empty());
        };
        match (list, &self.ranking) {
            (List::Nothing, _) => Box::new(std::iter::empty()),
            (List::Top(k), Some(ranked)) if distinct => {
                let list = ranked.list.iter().map(|r| &r.variant);
                let first = ideas::first_of_each(search, list, d).into_iter().take(k);
                Box::new(first.map(move |(at, idea)| of_idea(Some(at), idea)))
            }
            (List::Top(k), None) if distinct => {
                let ideas = search.list_ideas(d, k).into_iter();
                Box::new(ideas.map(move |idea| of_idea(None, idea)))
            }
            (List::Sample(n), _) => Box::new(search.sample_variants(d, seed).take(n).map(plain)),
            (List::Top(_), Some(ranked)) => {
                let list = ranked.list.iter().enumerate();
                Box::new(list.map(move |(place, r)| Listed {
                    place: Some(place),
                    ..plain(r.variant.clone())
                }))
            }
            (List::Top(_) | List::All, _) => {
                let cheapest = search.cheapest_variants(d, longest_list(list));
                Box::new(cheapest.map(plain))
            }
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

/// An entry of a list.
struct Listed {
    variant: Assignment,
    /// Its place in the ranking, if there is one.
    place: Option<usize>,
    /// Its idea, if only the first variant of each idea is listed.
    idea: Option<Idea>,
}

/// The variants of an outcome, one by one.
pub struct Variants<'o> {
    outcome: &'o Outcome,
    list: List,
    cancelled: ShouldCancel<'o>,
    source: Box<dyn Iterator<Item = Listed> + 'o>,
    /// Whether second opinions are wanted of those to come.
    opinions: bool,
    /// The poses in which the next ones are examined.
    stroke: Option<&'o Stroke>,
    /// Examined, and not given yet.
    ready: std::vec::IntoIter<(Certified, Option<usize>, Option<Idea>)>,
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
    /// Returns the findings of second opinions and other poses on the variants given so far.
    pub fn summary(&self) -> Summary {
        self.summary
    }

    /// Returns true if the list was cancelled.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    /// Returns the reason why the list ended early, as far as it goes. Either it or the ranking was interrupted, or it would
    /// have taken more than the available memory.
    pub fn cut_short(&self) -> Option<Stop> {
        let ranking = self.outcome.ranking.as_ref();
        if self.interrupted || ranking.is_some_and(|r| r.interrupted) {
            return Some(Stop::Interrupted);
        }
        self.short.then_some(Stop::Memory)
    }

    /// Returns the reason why the list is not complete: that of the list itself, otherwise that of the search.
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

    /// Returns the next variant with its opinions. Variants are collected first, so that they are analysed in parallel.
    fn next_certified(&mut self) -> Option<(Certified, Option<usize>, Option<Idea>)> {
        if let Some(next) = self.ready.next() {
            return Some(next);
        }
        if !self.opinions && self.stroke.is_none() {
            let next = self.source.next()?;
            return Some((
                Certified::without_opinion(next.variant),
                next.place,
                next.idea,
            ));
        }
        let search = &self.outcome.search;
        let size = singular_values::affordable_count(search);
        let block = self.source.by_ref().take(size);
        let (block, more): (Vec<_>, Vec<_>) = block.map(|l| (l.variant, (l.place, l.idea))).unzip();
        let certified = singular_values::certify_variants(
            search,
            block,
            self.opinions,
            self.stroke,
            self.cancelled,
        );
        let ready = certified.into_iter().zip(more);
        let ready = ready.map(|(certified, (place, idea))| (certified, place, idea));
        self.ready = ready.collect_vec().into_iter();
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
            let Some((certified, place, idea)) = self.next_certified() else {
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
                idea,
                certified,
                place,
            });
        }
        None
    }
}
