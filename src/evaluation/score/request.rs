//! A request to search, as a file or a command line states it: everything that determines the list of variants, and the checks of its
//! answer. In JSON it is an object with the fields as keys, without those that have their defaults.

pub(in crate::score) mod error;
pub(in crate::score) mod missing_options;
pub(in crate::score) mod option_rules;
pub mod prepare;
pub mod unlisted;
pub mod words;

use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::model::ranking::{Ranking, Term};
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::rank::rounded::verdict::settle_states;
pub use crate::score::request::error::RequestError;
use crate::score::request::prepare::{
    LooksRounded, Prepared, as_in_file, digits_of, nearest_exact, tell_moved,
};
use crate::search::question::conditions::{Conditions, InState, Symmetry};
use crate::search::question::kept::Drives;
use serde::{Deserialize, Deserializer};

/// How many of the cheapest variants a ranking scores, unless told otherwise, before it goes through the others. At about ten
/// microseconds each these take a fifth of a second.
pub const POOL: usize = 20_000;
/// Largest pool.
const LARGEST_POOL: usize = 100_000_000;

/// Options of one joint, by name.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct JointOptions {
    /// The joint.
    pub joint: String,
    /// Names of options. Empty means all changes.
    pub names: Vec<String>,
}

/// A file of costs, which are read where the mechanism is known that they are for.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct CostFile {
    /// Its name.
    pub name: String,
    /// Its text; see [`costs_from_str`](crate::file::read::search::costs_from_str).
    pub text: String,
}

/// Unloading joints offered at some joints, all by name.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Inserts {
    /// Types, or names that the file gives to unloading joints of these joints.
    pub names: Vec<String>,
    /// The joints. Empty means those that the searched state adds.
    pub joints: Vec<String>,
}

/// Which of the admissible variants are given.
///
/// # Examples
/// ```
/// use ozols::score::request::List;
/// let request = ozols::Request { list: List::All, ..Default::default() };
/// let outcome = ozols::search(&ozols::built_in("four-bar")?, &request)?;
/// assert_eq!(outcome.variants().count().to_string(), outcome.listed_counts().to_string());
/// # Ok::<(), ozols::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum List {
    /// The best so many.
    Top(usize),
    /// All, the cheapest first.
    All,
    /// So many drawn at random, each with the same chance.
    Sample(usize),
    /// None: counts only.
    Nothing,
}

/// Reads the number of best variants to list.
fn read_best<'de, D: Deserializer<'de>>(from: D) -> Result<List, D::Error> {
    usize::deserialize(from).map(List::Top)
}

/// How a search is checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Check {
    /// One prime, no second opinion.
    None,
    /// The whole search over two primes, which must agree.
    Prime,
    /// That, and the mechanism as built and each variant given, up to [`CHECKED`](crate::search::check::singular_values::CHECKED) and
    /// fewer of large mechanisms, analysed again by singular values.
    Full,
}

/// How variants are counted.
///
/// # Examples
/// ```
/// use ozols::score::request::Method;
/// let four_bar = ozols::built_in("four-bar")?;
/// let brute = ozols::Request { method: Method::Brute, ..Default::default() };
/// let [by_diagram, by_brute] = [&ozols::Request::default(), &brute].map(|r| ozols::search(&four_bar, r));
/// assert_eq!(by_diagram?.admissible.total, by_brute?.admissible.total); // Each of the 64 was looked at.
/// # Ok::<(), ozols::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// On the span diagram.
    Diagram,
    /// By looking at every one: counts only, for checking and comparison.
    Brute,
}

/// The word for an entry in a list of ideas.
pub(in crate::score) const IDEA: &str = "idea";
/// The word for an entry in a list of all variants.
pub(in crate::score) const VARIANT: &str = "variant";

/// A request to search.
///
/// The default is the main job: no redundant constraint within the mechanism, the motion of the outputs kept, the ten
/// cheapest variants, checked in full.
///
/// ```
/// let request = ozols::Request {
///     max_mobility: Some(1),
///     options: vec!["spherical".to_owned(), "cylindrical".to_owned()],
///     ..Default::default()
/// };
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a question")]
pub struct Request {
    /// Redundant constraints allowed within the mechanism; as many as the file allows where that is more.
    pub max_redundant: u32,
    /// Redundant constraints allowed from the joints that [`Request::state`] adds; takes those joints into the search.
    pub max_external: Option<u32>,
    /// Harmful ones allowed among them; takes those joints into the search.
    pub max_harmful: Option<u32>,
    /// The state that takes part; the first besides free where only limits in it are given.
    pub state: Option<String>,
    /// Whether objects may be loose in the searched state.
    pub allow_loose_object: bool,
    /// Largest mobility W allowed.
    pub max_mobility: Option<i64>,
    /// Most changes allowed.
    pub max_changes: Option<u32>,
    /// Whether outputs may move in other ways than now.
    pub allow_output_change: bool,
    /// The condition on drives, unless outputs may gain motions. `None` is that of the file.
    pub drives: Option<Drives>,
    /// Links that must not gain a motion, besides the outputs; bodies that the searched state adds must be held there.
    pub hold: Vec<String>,
    /// Unloading joints offered besides those of the file.
    pub unloading: Vec<Inserts>,
    /// The options used everywhere, by name. Empty means all of the file. Joint types that the file does not list are
    /// offered in the joints' own frames.
    pub options: Vec<String>,
    /// Options allowed at single joints.
    pub allow: Vec<JointOptions>,
    /// Options forbidden at single joints.
    pub forbid: Vec<JointOptions>,
    /// Costs instead of the file's and the defaults. A cost at an option of the file remains.
    pub costs: Option<CostFile>,
    /// Mirror symmetry.
    pub symmetry: Symmetry,
    /// Whether a file whose coordinates are rounded is searched exactly as it is written, though something else is meant.
    pub as_written: bool,
    /// Whether variants are counted, or no more of the diagram is built than the best need.
    pub counted: bool,
    /// Whether variants are counted by W and by changes, but not by both: where nobody reads such a table.
    #[serde(skip)]
    pub only_sums: bool,
    /// Node budget of each diagram.
    pub nodes: usize,
    /// Bytes that the search, its counts, its lists and its ranking may hold, so far as they grow with what is found.
    pub memory: usize,
    /// Terms to rank by with their weights, in place of the file's.
    #[serde(deserialize_with = "words::weighted_terms")]
    pub rank: Vec<(Term, f64)>,
    /// How many of the cheapest variants a ranking scores, and no others. `None` is [`POOL`] and then all others that could come before
    /// the last of the list.
    pub pool: Option<usize>,
    /// Which variants are given. In JSON it is `top`, a number.
    #[serde(rename = "top", deserialize_with = "read_best")]
    pub list: List,
    /// Whether of the variants that give the same freedoms to the same joints in series only the first is given.
    pub distinct: bool,
    /// How the search is checked.
    pub check: Check,
    /// How variants are counted.
    pub method: Method,
    /// Number of further poses of the original motion in which variants are examined.
    pub poses: usize,
    /// Whether only the drawn pose is asked about, and not which variants keep the motion throughout.
    pub pose_only: bool,
    /// Seed of samples and poses.
    pub seed: u64,
}

impl Default for Request {
    fn default() -> Self {
        Request {
            max_redundant: 0,
            max_external: None,
            max_harmful: None,
            state: None,
            allow_loose_object: false,
            max_mobility: None,
            max_changes: None,
            allow_output_change: false,
            drives: None,
            hold: Vec::new(),
            unloading: Vec::new(),
            options: Vec::new(),
            allow: Vec::new(),
            forbid: Vec::new(),
            costs: None,
            symmetry: Symmetry::All,
            counted: true,
            only_sums: false,
            as_written: false,
            nodes: Conditions::default().nodes,
            memory: Conditions::default().memory,
            rank: Vec::new(),
            pool: None,
            list: List::Top(10),
            distinct: false,
            check: Check::Full,
            method: Method::Diagram,
            poses: 0,
            pose_only: false,
            seed: 1,
        }
    }
}

impl Request {
    /// Returns the word for an entry of the list: "idea" or "variant". The third entries of the two lists are different mechanisms.
    pub fn noun_of_one(&self) -> &'static str {
        if self.distinct { IDEA } else { VARIANT }
    }

    /// Makes a mechanism ready. `tell` hears what was moved.
    ///
    /// # Errors
    /// Returns an error if the request names something that the mechanism does not have.
    pub fn prepare(
        &self,
        mechanism: Mechanism,
        tell: &mut dyn FnMut(String),
    ) -> Result<Prepared, RequestError> {
        if let Some(named) = self.in_words_of_types(&mechanism) {
            return named.prepare(mechanism, tell);
        }
        let state = self.searched_state(&mechanism)?.map(|s| s.state);
        let states: Vec<StateId> = std::iter::once(StateId::FREE).chain(state).collect();
        let mut settled = settle_states(&mechanism, &states)?;
        let looked_at = !settled.verdicts.is_empty();
        let planar = matches!(mechanism.mode, Mode::Planar { .. });
        // In a plane joints have no freedom as they are written.
        let whole = settled.snapped.as_ref().filter(|_| planar);
        let file = looked_at.then(|| whole.unwrap_or(&mechanism).clone());
        let mut out = mechanism;
        let numeric = settled.open.filter(|_| !self.as_written);
        let numeric = numeric.map(|_| digits_of(&settled.verdicts));
        if !self.as_written {
            tell_moved(&settled, tell);
            let meant = settled.snapped.take();
            let near = || numeric.and_then(|_| nearest_exact(&out, &settled.verdicts));
            out = meant.or_else(near).unwrap_or(out);
        } else if let Some(i) = settled.verdicts.iter().position(|v| !v.is_as_written()) {
            settled.open.get_or_insert(i);
        }
        if let Some(file) = &self.costs {
            prepare::read_costs(&mut out, &file.name, &file.text)?;
        }
        self.offer_usual(&mut out, tell);
        self.offer_unlisted(&mut out, tell)?;
        self.restrict_options(&mut out)?;
        self.insert_unloading(&mut out)?;
        let file = file.filter(|_| numeric.is_none());
        let written = file.map(|f| as_in_file(&out, &f, &settled));
        Ok(Prepared {
            written,
            mechanism: out,
            settled,
            numeric,
        })
    }

    /// Returns the intended mechanism in all its states. Returns it as written if the request requires this, or if there is
    /// no exact intended geometry. `tell` receives what was moved, or why nothing was.
    ///
    /// # Errors
    /// Returns an error if there is no verdict on the mechanism.
    pub fn meant_mechanism(
        &self,
        mechanism: &Mechanism,
        tell: &mut dyn FnMut(String),
    ) -> Result<Mechanism, RequestError> {
        if self.as_written {
            return Ok(mechanism.clone());
        }
        let states: Vec<StateId> = mechanism.states_with_ids().map(|(s, _)| s).collect();
        let settled = settle_states(mechanism, &states)?;
        tell_moved(&settled, tell);
        if settled.open.is_some() {
            tell("written unchanged: the intended geometry is not exact, or the digits do not decide it (see `ozols check`)".to_owned());
        }
        Ok(settled.snapped.unwrap_or_else(|| mechanism.clone()))
    }

    /// Returns the searched state, with the conditions on variants in it.
    ///
    /// # Errors
    /// Returns an error if the mechanism has no such state.
    pub fn searched_state(&self, mechanism: &Mechanism) -> Result<Option<InState>, RequestError> {
        let state = match &self.state {
            None if self.max_external.is_none() && self.max_harmful.is_none() => {
                return Ok(None);
            }
            None if mechanism.states.len() < 2 => {
                return Err(RequestError::OnlyFree {
                    mechanism: mechanism.name.clone(),
                });
            }
            None => StateId::new(1),
            Some(name) => mechanism
                .state_named(name)
                .ok_or_else(|| RequestError::NoState {
                    mechanism: mechanism.name.clone(),
                    state: name.clone(),
                    known: mechanism.states.clone(),
                })?,
        };
        Ok((state != StateId::FREE).then_some(InState {
            state,
            max_external: self.max_external,
            max_harmful: self.max_harmful,
            hold_objects: !self.allow_loose_object,
        }))
    }

    /// Returns the conditions on the variants of a prepared mechanism, with limits of its file that the request does not set. Also
    /// returns why its geometry looks rounded, if that may matter; `tell` is warned of that.
    ///
    /// # Errors
    /// Returns an error if the request names something that the mechanism does not have.
    pub fn search_conditions(
        &self,
        prepared: &Prepared,
        tell: &mut dyn FnMut(String),
    ) -> Result<(Conditions, Option<LooksRounded>), RequestError> {
        let state = self.searched_state(&prepared.mechanism)?;
        let rounded = prepared.looks_rounded(self.as_written, tell);
        let verdicts = rounded.iter().flat_map(|(_, v)| v);
        // Second opinions are read at the errors of what is searched.
        let tolerance = match &prepared.settled {
            s if s.understood.is_none() || s.open.is_some() => {
                verdicts.fold(DEFAULT_TOLERANCE, |a, v| a.max(v.tolerance))
            }
            _ => DEFAULT_TOLERANCE,
        };
        let file = &prepared.mechanism.search;
        let symmetry = match self.symmetry {
            Symmetry::All if file.symmetric => Symmetry::SymmetricOnly,
            asked => asked,
        };
        let conditions = Conditions {
            max_redundant: self.max_redundant.max(file.max_redundant),
            state,
            max_mobility: self.max_mobility.or(file.max_mobility),
            max_changes: self.max_changes,
            keep_output: !self.allow_output_change,
            drives: self.drives.unwrap_or(file.drive_rule),
            symmetry,
            throughout: !self.pose_only && !file.pose_only,
            counted: self.counted,
            cheapest: self.cheapest_needed(&prepared.mechanism)?,
            estimate: (self.symmetry != Symmetry::OnePerOrbit).then_some(self.seed),
            nodes: self.nodes.clamp(1, u32::MAX as usize / 2),
            memory: self.memory,
            tolerance,
            numeric: prepared.numeric,
            written: prepared.written.clone(),
        };
        Ok((conditions, rounded))
    }

    /// Returns the ranking of the file, with the terms of the request if it names some. `None` if neither requests one.
    ///
    /// # Errors
    /// Returns an error if the pool is 0 or too large.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::ranking::Term;
    /// let four_bar = ozols::built_in("four-bar")?;
    /// assert!(ozols::Request::default().asked_ranking(&four_bar)?.is_none());
    /// let request = ozols::Request { rank: vec![(Term::Cost, 1.0)], ..Default::default() };
    /// assert!(request.asked_ranking(&four_bar)?.is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn asked_ranking(&self, mechanism: &Mechanism) -> Result<Option<Ranking>, RequestError> {
        let mut ranking = mechanism.ranking.clone();
        if !self.rank.is_empty() {
            ranking.get_or_insert_default().terms.clone_from(&self.rank);
        }
        let harm = ranking.iter().flat_map(|r| &r.terms);
        if harm.clone().any(|(t, _)| *t == Term::Harmful)
            && self.searched_state(mechanism)?.is_none()
        {
            let some = mechanism.states.get(1);
            return Err(RequestError::HarmfulWhere {
                state: some.cloned().unwrap_or_else(|| "clamped".to_owned()),
            });
        }
        if ranking.is_some() && !(1..=LARGEST_POOL).contains(&self.cheapest_scored()) {
            return Err(RequestError::Pool { most: LARGEST_POOL });
        }
        Ok(ranking)
    }

    /// Returns the number of the cheapest variants that a ranking scores before it examines the others. As [`Request::pool`]
    /// of another request, the ranking covers only these.
    pub fn cheapest_scored(&self) -> usize {
        self.pool.unwrap_or(POOL)
    }
}
