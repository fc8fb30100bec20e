//! Results of a search: counts, their checks, and the variants one by one.

pub mod listing;
mod proof;
pub(in crate::score) mod ranked;
pub mod ranking;
pub mod remarks;
pub mod symmetric;
pub mod variant;
pub mod why;

use crate::score::outcome::ranking::RankedPool;
use crate::score::request::Request;
use crate::score::request::prepare::LooksRounded;
use crate::search::Search;
use crate::search::answer::counts;
use crate::search::answer::counts::Counts;
use crate::search::answer::estimate::Estimate;
use crate::search::answer::everywhere::count_everywhere;
use crate::search::answer::search_counts::SearchCounts;
use crate::search::at_tolerance::AtTolerance;
use crate::search::check::other_poses::Stroke;
use crate::search::check::second_opinion::SecondOpinion;
use crate::search::check::second_prime::PrimeCheck;
use crate::search::diagram::Stop;
use crate::search::question::conditions::Symmetry;
use crate::search::question::throughout::PoseOnly;
use crate::search::solve::Diagrams;
use num_bigint::BigUint;
use std::collections::BTreeMap;

/// The results of a search.
///
/// # Examples
/// ```
/// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
/// assert_eq!(outcome.determinate.to_string(), "6340592477");
/// assert_eq!(outcome.admissible.to_string(), "25761436"); // In the drawn pose.
/// assert!(outcome.lasting.as_ref().is_ok_and(|n| n.to_string() == "21817629"));
/// # Ok::<(), ozols::Error>(())
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub struct Outcome {
    /// The search: the mechanism as it was searched, the conditions, the space.
    pub search: Search,
    /// The request.
    pub request: Request,
    /// Counts by the redundancy condition of the free state.
    pub determinate: Counts,
    /// Counts by every condition.
    pub admissible: Counts,
    /// Counts of the admissible variants that keep the motion throughout the motion of the mechanism as built, or why only the drawn pose
    /// is known.
    pub lasting: Result<Counts, PoseOnly>,
    /// The diagrams; `None` for brute force.
    pub diagrams: Option<Diagrams>,
    /// Why the search ended.
    pub stop: Stop,
    /// Why the search for the determinate variants ended, which come first.
    pub determinate_stop: Stop,
    /// The comparison with a second prime; `None` if there was none.
    pub check: Option<PrimeCheck>,
    /// Why the geometry looks measured, with the verdicts on the original mechanism; `None` if it looks exact.
    pub measured: Option<LooksRounded>,
    /// Other poses of the original motion; `None` if none were asked for.
    pub stroke: Option<Stroke>,
    /// The ranking under a workload; `None` if the order is that of cost.
    pub ranking: Option<RankedPool>,
    /// The results by singular values, if exact arithmetic cannot represent the mechanism that is meant. Counts are then those of the
    /// variants that are sure.
    pub numeric: Option<AtTolerance>,
    /// What singular values say of the counts, where coordinates look rounded and exact arithmetic counted all the same.
    pub second: Option<SecondOpinion>,
}

impl Outcome {
    /// Creates an outcome from the counts only.
    pub(super) fn of_counts(
        search: Search,
        request: Request,
        counts: SearchCounts,
        measured: Option<LooksRounded>,
    ) -> Outcome {
        let SearchCounts {
            determinate,
            admissible,
            lasting,
        } = counts;
        let lasting =
            lasting.ok_or_else(|| search.pose_only().cloned().unwrap_or(PoseOnly::Budget));
        Outcome {
            search,
            request,
            determinate,
            admissible,
            lasting,
            diagrams: None,
            stop: Stop::Exhausted,
            determinate_stop: Stop::Exhausted,
            check: None,
            measured,
            stroke: None,
            ranking: None,
            numeric: None,
            second: None,
        }
    }

    /// Returns the counts of the listed variants: those that keep the motion throughout, or the admissible ones if these are not known.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
    /// assert_eq!(outcome.listed_counts().to_string(), "21817629"); // Those that keep the motion throughout.
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn listed_counts(&self) -> &Counts {
        self.lasting.as_ref().unwrap_or(&self.admissible)
    }

    /// Returns the number of variants that have σ = 0 and keep the motion in poses near the drawn one. The drawn pose may be singular for
    /// them, so they are those that last and others. `None` if no motion is followed, W or changes are limited, or there are too many.
    ///
    /// # Complexity
    /// O(m³) field operations for each of up to 1,000 nodes of a layer and each choice, for m rows at four powers of the motion.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// assert_eq!(outcome.listed_counts().to_string(), "14");
    /// assert_eq!(outcome.count_everywhere(), Some(18u32.into())); // Four are singular just where drawn.
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn count_everywhere(&self) -> Option<BigUint> {
        let lasting = self.diagrams.as_ref()?.lasting.as_ref().ok()?;
        let all = self.request.symmetry != Symmetry::OnePerOrbit;
        all.then(|| count_everywhere(&self.search, lasting))?
    }

    /// Returns whether exact arithmetic examined everything, and singular values do not contradict it if coordinates look rounded. Counts
    /// are then exact, and no list is better.
    ///
    /// # Examples
    /// ```
    /// let four_bar = ozols::built_in("four-bar")?;
    /// assert!(ozols::search(&four_bar, &ozols::Request::default())?.is_exact());
    /// let hasty = ozols::Request { nodes: 2, ..Default::default() };
    /// assert!(!ozols::search(&four_bar, &hasty)?.is_exact()); // The budget ended it.
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn is_exact(&self) -> bool {
        self.is_counted() && self.is_confirmed()
    }

    /// Returns whether exact arithmetic examined everything, regardless of rounded coordinates.
    pub fn is_counted(&self) -> bool {
        self.stop == Stop::Exhausted && self.numeric.is_none()
    }

    /// Returns true if no numerical check contradicts exact arithmetic.
    pub fn is_confirmed(&self) -> bool {
        self.second.as_ref().is_none_or(SecondOpinion::confirms)
    }

    /// Returns true if every variant was judged by singular values.
    pub fn is_numeric_whole(&self) -> bool {
        self.numeric.as_ref().is_some_and(AtTolerance::is_whole)
    }

    /// Returns whether there may be more admissible variants, because singular values do not decide some.
    pub fn admissible_may_be_more(&self) -> bool {
        let found = self.numeric.as_ref();
        found.is_some_and(|f| !f.admissible.is_narrow())
    }

    /// Returns true if the determinate variants are counted exactly, even if the rest of the search ended early.
    pub fn is_determinate_exact(&self) -> bool {
        self.is_determinate_counted() && self.is_confirmed()
    }

    /// Returns whether exact arithmetic examined all that may be determinate, regardless of rounded coordinates.
    pub fn is_determinate_counted(&self) -> bool {
        self.determinate_stop == Stop::Exhausted && self.numeric.is_none()
    }

    /// Returns the cost in thousandths up to which every admissible variant is known, even if the search ended early. `None`
    /// if this holds for no cost.
    pub fn known_up_to(&self) -> Option<i64> {
        let found = self.diagrams.as_ref().filter(|_| self.is_confirmed());
        found?.known_up_to()
    }

    /// Returns the estimated numbers of determinate and admissible variants, if the search ended early.
    pub fn estimates(&self) -> [Option<&Estimate>; 2] {
        let found = self.diagrams.as_ref();
        [0, 1].map(|i| found.and_then(|d| d.estimates[i].as_ref()))
    }

    /// Returns the number of minimal admissible variants: no other one has only a part of their freedoms. Returns `None` if it is not
    /// known exactly: the search ended early or is numeric, orbits are counted, or it takes too many nodes.
    ///
    /// # Complexity
    /// That of a diagram of the minimal variants.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// assert_eq!(outcome.count_minimal(), Some(12u32.into()));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn count_minimal(&self) -> Option<BigUint> {
        let found = self.diagrams.as_ref().filter(|_| self.is_exact());
        self.search.count_minimal(found?)
    }

    /// Returns the numbers of admissible variants by cost in thousandths. `None` for orbits, for brute force, and if they
    /// would take more than the available memory.
    ///
    /// # Complexity
    /// One more tally of the diagram.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// let by_cost = outcome.admissible_by_cost().unwrap_or_default();
    /// let cheapest = outcome.variants().next().map(|v| v.cost_milli());
    /// assert_eq!(by_cost.keys().next().copied(), cheapest);
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn admissible_by_cost(&self) -> Option<BTreeMap<i64, BigUint>> {
        if let Some(found) = &self.numeric {
            return Some(found.by_cost.clone());
        }
        match &self.diagrams {
            Some(d) if self.request.symmetry != Symmetry::OnePerOrbit => {
                counts::counts_by_cost(&self.search, &d.admissible)
            }
            _ => Some(BTreeMap::new()),
        }
    }

    /// Returns the counts by cost of those of them that keep the motion throughout; `None` where these are not known, or as
    /// [`Outcome::admissible_by_cost`].
    pub fn lasting_by_cost(&self) -> Option<BTreeMap<i64, BigUint>> {
        let diagrams = self.diagrams.as_ref();
        let lasting = diagrams.and_then(|d| d.lasting.as_ref().ok());
        let lasting = lasting.filter(|_| self.request.symmetry != Symmetry::OnePerOrbit);
        counts::counts_by_cost(&self.search, lasting?)
    }
}
