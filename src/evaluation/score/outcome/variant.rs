//! A variant: its place, figures, changes, opinions and scores, and the mechanism that it is.

use crate::closure::Closure;
use crate::file::read::resolve::contains_option;
use crate::geom::exact::ExactError;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, JointId, Mechanism, Parts, StateId};
use crate::redundancy::contour_shares::{ContourShare, contour_shares};
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::Outcome;
use crate::score::outcome::ranking::Ranked;
use crate::score::request::{IDEA, VARIANT};
use crate::search::Search;
use crate::search::answer::ideas::Idea;
use crate::search::answer::k_best::Assignment;
use crate::search::check::other_poses::OverStroke;
use crate::search::check::singular_values::{Certified, Second};
use crate::search::check::variant_mechanism;
use crate::search::question::space::choice_name;
use itertools::Itertools;
use std::fmt;

/// A joint that a variant changes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// The joint.
    pub joint: JointId,
    /// The present option, by name.
    pub from: String,
    /// The new type.
    pub to: String,
}

/// A variant of a mechanism.
#[derive(Debug, Clone)]
pub struct Variant<'o> {
    pub(in crate::score) outcome: &'o Outcome,
    pub(in crate::score) position: usize,
    pub(in crate::score) certified: Certified,
    pub(in crate::score) idea: Option<Idea>,
    /// Place in the ranking, from 0.
    pub(in crate::score) place: Option<usize>,
}

impl<'o> Variant<'o> {
    /// Returns the outcome that contains the variant.
    pub fn outcome(&self) -> &'o Outcome {
        self.outcome
    }

    /// Returns the place in the list, from 1.
    pub fn position(&self) -> usize {
        self.position
    }

    /// Returns its choice for each variable of the space, and its properties in the diagram.
    pub fn assignment(&self) -> &Assignment {
        &self.certified.variant
    }

    /// Returns its idea, if the list has only the first variant of each idea.
    pub fn idea(&self) -> Option<&Idea> {
        self.idea.as_ref()
    }

    /// Returns the cost above the original mechanism's, in thousandths.
    pub fn cost_milli(&self) -> i64 {
        self.outcome
            .search
            .steps
            .cost_in_milli(self.assignment().key.cost())
    }

    /// Returns the cost above the original mechanism's.
    pub fn cost(&self) -> f64 {
        self.cost_milli() as f64 / 1000.0
    }

    /// Returns the mobility W in the free state.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// // W = f - 6k + σ, with σ = 0: the four-bar turns, and some variants have an idle motion besides.
    /// assert!(outcome.variants().all(|v| v.redundant() == 0 && v.mobility() >= 1));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn mobility(&self) -> i64 {
        self.outcome.search.mobility(self.assignment().key)
    }

    /// Returns the number of redundant constraints σ in the free state.
    pub fn redundant(&self) -> u32 {
        self.assignment().key.internal()
    }

    /// Returns the number of redundant constraints that the searched state adds; `None` without such a state.
    pub fn external_redundant(&self) -> Option<i32> {
        let searched = self.outcome.search.conditions.state;
        searched.map(|_| self.assignment().key.external())
    }

    /// Returns the number of harmful ones among them: self-stresses that load the joints the state adds with more than
    /// friction.
    pub fn external_harmful(&self) -> Option<u32> {
        let searched = self.outcome.search.conditions.state;
        searched.map(|_| self.assignment().key.harmful())
    }

    /// Returns the number of changed joints and inserted unloading joints.
    pub fn change_count(&self) -> u32 {
        self.assignment().key.changes()
    }

    /// Returns the joints that it changes, in file order.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
    /// let best = outcome.variants().next().expect("there are 14");
    /// assert_eq!(best.list_changes().len(), best.change_count() as usize);
    /// assert!(best.list_changes().iter().all(|c| c.from == "revolute"));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn list_changes(&self) -> Vec<Change> {
        list_changes(&self.outcome.search, self.assignment())
    }

    /// Returns the second opinion by singular values.
    pub fn second(&self) -> &Second {
        &self.certified.second
    }

    /// Returns the results in other poses, if they were asked for.
    pub fn over_stroke(&self) -> Option<&OverStroke> {
        self.certified.stroke.as_ref()
    }

    /// Returns whether other poses were examined and give other figures.
    pub fn is_lucky(&self) -> bool {
        self.certified.is_lucky()
    }

    /// Returns its entry in the ranking, if there is one.
    pub fn ranked(&self) -> Option<&'o Ranked> {
        self.outcome.ranking.as_ref()?.list.get(self.place?)
    }

    /// Returns the scores under the workload, if the variant was ranked.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::ranking::Term;
    /// let loaded = ozols::built_in("gripper-10-loaded")?;
    /// let rank = vec![(Term::PeakForce, 1.0)];
    /// let request = ozols::Request { rank, pool: Some(20), ..Default::default() };
    /// let outcome = ozols::search(&loaded, &request)?;
    /// let scores = outcome.variants().filter_map(|v| v.scores());
    /// let peaks: Vec<f64> = scores.map(|s| s.term_value(Term::PeakForce)).collect();
    /// assert!(peaks.len() == 10 && peaks[0] <= peaks[9]);
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn scores(&self) -> Option<&'o Scores> {
        self.ranked().map(|r| &r.scores)
    }

    /// Returns the reason why the place in the ranking is not that by cost.
    pub fn place_reason(&self) -> Option<String> {
        let pool = self.outcome.ranking.as_ref()?;
        pool.place_reason(&self.outcome.search.mechanism, self.place? + 1)
    }

    /// Returns the name: "idea 3" in a list of ideas, "variant 3" in one of all variants.
    pub fn name(&self) -> String {
        let one = if self.idea.is_some() { IDEA } else { VARIANT };
        format!("{one} {}", self.position)
    }

    /// Returns the variant as a mechanism, named after its place in the list.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
    /// let best = outcome.variants().next().expect("there are 21,817,629").as_mechanism();
    /// let free = &ozols::analyze(&best)?[0];
    /// assert_eq!((free.mobility, free.redundant), (1, 0));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn as_mechanism(&self) -> Mechanism {
        as_mechanism(&self.outcome.search, self.assignment(), &self.name())
    }

    /// Returns σ of each contour when they are added in this order, with the range over all orders of these. It is that of
    /// the searched state, whose own contours come last, or of the free state. Empty if no contour has any.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field of the search.
    ///
    /// # Complexity
    /// Some eliminations of J for each call.
    ///
    /// # Examples
    /// ```
    /// let left = ozols::Request { max_redundant: 1, max_changes: Some(1), ..Default::default() };
    /// let outcome = ozols::search(&ozols::built_in("four-bar")?, &left)?;
    /// for v in outcome.variants() {
    ///     assert_eq!(v.redundant_by_contour()?.len(), 1); // The one loop has it.
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn redundant_by_contour(&self) -> Result<Vec<(String, ContourShare)>, ExactError> {
        let (search, key) = (&self.outcome.search, self.assignment().key);
        // Exact arithmetic does not know of a mechanism that is judged by singular values.
        if key.internal() == 0 && key.external() == 0 || self.outcome.numeric.is_some() {
            return Ok(Vec::new());
        }
        let state = search.conditions.state.map_or(StateId::FREE, |s| s.state);
        let realized = variant_mechanism::realize_variant(search, &self.assignment().choices);
        let closure = Closure::new(search.field(), &realized, state)?;
        let shares = contour_shares(search.field(), &closure).into_iter();
        Ok(shares.map(|s| (s.contour.name(&realized), s)).collect())
    }
}

/// A line such as `1. cost 11, W = 1, σ = 0: 1-2, 1-5 -> spherical; 2-4 -> cylindrical`.
impl fmt::Display for Variant<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (w, sigma) = (self.mobility(), self.redundant());
        write!(
            f,
            "{}. cost {}, W = {w}, σ = {sigma}",
            self.position,
            self.cost()
        )?;
        if let Some(e) = self.external_redundant() {
            write!(f, " + {e}")?;
        }
        if let Some(n) = self.external_harmful() {
            write!(f, " ({n} harmful)")?;
        }
        let changes = in_words(&self.outcome.search, &self.list_changes());
        write!(f, ": {changes}")
    }
}

/// Returns a choice of options as a mechanism, named after its place in a list: "variant 3".
pub fn as_mechanism(search: &Search, assignment: &Assignment, name: &str) -> Mechanism {
    let mut out = variant_mechanism::realize_variant(search, &assignment.choices);
    let mut parts = out.edit();
    parts.description = format!(
        "{} of {}: {}",
        capitalize(name),
        parts.name,
        in_words(search, &list_changes(search, assignment))
    );
    parts.name = format!("{}-{}", parts.name, name.replace(' ', "-"));
    offer_again(search, assignment, &mut parts);
    drop(parts);
    out
}

/// Returns a name with a capital letter, as at the start of a sentence.
fn capitalize(name: &str) -> String {
    let mut letters = name.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

/// Puts back what a search may still choose, so that a variant can be searched again: what was offered at a joint and allows
/// what that joint does now, its costs and mirror images, under the same names.
fn offer_again(search: &Search, assignment: &Assignment, out: &mut Parts) {
    let old = &search.mechanism;
    let chosen = variant_mechanism::chosen_options(search, &assignment.choices);
    for (j, joint) in old.joints_with_ids() {
        let (option, unloading, _) = chosen[j.index()];
        let Some(present) = joint.options.get(option) else {
            continue;
        };
        let more = joint
            .options
            .iter()
            .skip(1)
            .filter(|o| o.name != present.name && contains_option(o, present) == Some(true));
        out.joints[j].options = std::iter::once(present).chain(more).cloned().collect();
        if unloading.is_none() {
            out.joints[j].unloading.clone_from(&joint.unloading);
        }
    }
    let offered = |name: &str| {
        let mut all = out.joints.iter().flat_map(Joint::offered_options);
        JointType::from_name(name).is_some() || all.any(|o| o.name == name)
    };
    let mut spec = old.search.clone();
    spec.costs.by_type_milli.retain(|(name, _)| offered(name));
    let images = |&(a, b): &(JointId, JointId)| chosen[a.index()] == chosen[b.index()];
    spec.mirror.retain(images);
    spec.turn
        .retain(|g| g.iter().map(|j| chosen[j.index()]).all_equal());
    out.joint_types
        .retain(|t| t.name == "custom" || offered(&t.name));
    out.search = spec;
}

/// Returns the joints that a choice of options changes, in file order.
pub fn list_changes(search: &Search, assignment: &Assignment) -> Vec<Change> {
    let mut out = Vec::new();
    let variables = search.space.variables.iter().zip(&assignment.choices);
    for (v, &choice) in variables.filter(|(_, c)| **c != 0) {
        out.extend(v.joints.iter().map(|&joint| Change {
            joint,
            from: choice_name(&search.mechanism, joint, &v.choices[0]),
            to: choice_name(&search.mechanism, joint, &v.choices[choice]),
        }));
    }
    out.sort_by_key(|c| c.joint);
    out
}

/// Describes changes in words: "3-0, 7-0 -> spherical; 5-1 -> cylindrical".
pub fn in_words(search: &Search, changes: &[Change]) -> String {
    let mut alike: Vec<(&str, Vec<&str>)> = Vec::new();
    for c in changes {
        let joint = search.mechanism.joints[c.joint].id.as_str();
        match alike.iter_mut().find(|(to, _)| *to == c.to) {
            Some((_, joints)) => joints.push(joint),
            None => alike.push((&c.to, vec![joint])),
        }
    }
    if alike.is_empty() {
        return "none: the original mechanism".to_owned();
    }
    alike
        .iter()
        .map(|(to, joints)| format!("{} -> {to}", joints.join(", ")))
        .join("; ")
}
