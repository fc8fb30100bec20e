//! What is asked of a search, in the words of a file or a command line: everything that decides the list of variants, and
//! how its answer is checked.

use crate::geom::exact::ExactError;
use crate::model::measured::{Measured, looks_measured};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::model::ranking::{Ranking, Term};
use crate::rank::measured::{VerdictError, Verdicts};
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::rank::snap::snap;
use crate::redundancy::analysis::exact_field;
use crate::search::conditions::{Conditions, Symmetry};
use thiserror::Error;

/// How many of the cheapest variants a ranking scores at most, unless told otherwise: it ends before where the best are
/// proven. At about ten microseconds each these take a fifth of a second.
pub const POOL: usize = 20_000;
/// Largest pool.
const LARGEST_POOL: usize = 100_000_000;

/// Options of one joint, by name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointOptions {
    /// The joint.
    pub joint: String,
    /// Names of options; none where all changes are meant.
    pub names: Vec<String>,
}

/// Which of the admissible variants are given.
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

/// How a search is checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Check {
    /// One prime, no second opinion.
    None,
    /// The whole search over two primes, which must agree.
    Prime,
    /// That, and each variant given, up to [`CHECKED`](crate::search::certify::CHECKED), analysed again by singular values.
    Full,
}

/// How variants are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// On the span diagram.
    Diagram,
    /// By looking at every one: counts only, for checking and comparison.
    Brute,
}

/// What is asked of a search.
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
#[derive(Debug, Clone, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a question")]
pub struct Request {
    /// Redundant constraints allowed within the mechanism.
    pub max_redundant: u32,
    /// Redundant constraints allowed from the joints that [`Request::state`] adds; takes those joints into the search.
    pub max_external: Option<u32>,
    /// The state meant by [`Request::max_external`]; the first besides free where none is named.
    pub state: Option<String>,
    /// Largest mobility W allowed.
    pub max_mobility: Option<i64>,
    /// Most changes allowed.
    pub max_changes: Option<u32>,
    /// Whether outputs may move in other ways than now.
    pub allow_output_change: bool,
    /// Links that must not gain a motion, besides the outputs.
    pub hold: Vec<String>,
    /// The options used everywhere, by name; all of the file where there are none.
    pub options: Vec<String>,
    /// Options allowed at single joints.
    pub allow: Vec<JointOptions>,
    /// Options forbidden at single joints.
    pub forbid: Vec<JointOptions>,
    /// Mirror symmetry.
    pub symmetry: Symmetry,
    /// Whether a file whose coordinates look measured is searched exactly as it is written.
    pub as_written: bool,
    /// Make axes exactly parallel, square, coaxial or concurrent that are so to within this (radians, and fractions of the
    /// largest coordinate).
    pub snap: Option<f64>,
    /// Node budget of each diagram.
    pub nodes: usize,
    /// Terms to rank by with their weights, in place of the file's.
    pub rank: Vec<(Term, f64)>,
    /// How many of the cheapest variants a ranking scores.
    pub pool: usize,
    /// Which variants are given.
    pub list: List,
    /// How the search is checked.
    pub check: Check,
    /// How variants are counted.
    pub method: Method,
    /// Further poses of the present motion that variants are looked at in.
    pub poses: usize,
    /// Leave out the variants whose figures are others in further poses.
    pub generic_only: bool,
    /// Seed of samples and poses.
    pub seed: u64,
}

impl Default for Request {
    fn default() -> Self {
        Request {
            max_redundant: 0,
            max_external: None,
            state: None,
            max_mobility: None,
            max_changes: None,
            allow_output_change: false,
            hold: Vec::new(),
            options: Vec::new(),
            allow: Vec::new(),
            forbid: Vec::new(),
            symmetry: Symmetry::All,
            as_written: false,
            snap: None,
            nodes: Conditions::default().nodes,
            rank: Vec::new(),
            pool: POOL,
            list: List::Top(10),
            check: Check::Full,
            method: Method::Diagram,
            poses: 0,
            generic_only: false,
            seed: 1,
        }
    }
}

/// What is wrong with a request about a mechanism.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RequestError {
    /// A tolerance that is none.
    #[error("--snap must be between 0 and 1")]
    Snap,
    /// A pool that is none, or too large.
    #[error("--pool must be from 1 to {LARGEST_POOL}")]
    Pool,
    /// No such link.
    #[error("--hold: {mechanism} has no link {link}")]
    NoLink {
        /// Name of the mechanism.
        mechanism: String,
        /// The link asked for.
        link: String,
    },
    /// No such joint.
    #[error("{flag}: {mechanism} has no joint {joint}")]
    NoJoint {
        /// Which part of the request.
        flag: &'static str,
        /// Name of the mechanism.
        mechanism: String,
        /// The joint asked for.
        joint: String,
    },
    /// No such option.
    #[error("{flag}: no joint of {mechanism} has an option named {option}; there are: {}", known.join(", "))]
    NoOption {
        /// Which part of the request.
        flag: &'static str,
        /// Name of the mechanism.
        mechanism: String,
        /// The option asked for.
        option: String,
        /// The options that there are.
        known: Vec<String>,
    },
    /// A joint to which nothing is allowed.
    #[error("--allow needs names of options: --allow {joint}=revolute,spherical")]
    NoNames {
        /// The joint.
        joint: String,
    },
    /// No state to take joints from.
    #[error("{mechanism} has no state besides free")]
    OnlyFree {
        /// Name of the mechanism.
        mechanism: String,
    },
    /// No such state.
    #[error("{mechanism} has no state {state}; it has: {}", known.join(", "))]
    NoState {
        /// Name of the mechanism.
        mechanism: String,
        /// The state asked for.
        state: String,
        /// The states that there are.
        known: Vec<String>,
    },
    /// Coordinates that look measured, where that changes the figures.
    #[error("{0}; {CURE}, or search the file --as-written")]
    Measured(String),
    /// The geometry has no image in a prime field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// Exact and tolerant ranks could not be had.
    #[error(transparent)]
    Verdicts(#[from] VerdictError),
}

/// What to do about measured coordinates.
const CURE: &str = "round the coordinates, write expressions such as sqrt(3)/2, or snap them with --snap TOLERANCE";

/// Why a geometry looks measured, with the verdicts on the mechanism as it is.
pub type LooksMeasured = (Measured, Vec<Verdicts>);

impl Request {
    /// The mechanism that is searched: snapped, and with the options that the request leaves. `tell` hears what was moved.
    ///
    /// # Errors
    /// Where the request names what the mechanism has not.
    pub fn prepare(
        &self,
        mut mechanism: Mechanism,
        tell: &mut dyn FnMut(String),
    ) -> Result<Mechanism, RequestError> {
        if let Some(tolerance) = self.snap {
            if tolerance.is_nan() || tolerance <= 0.0 || tolerance >= 1.0 {
                return Err(RequestError::Snap);
            }
            let snapped = snap(&mechanism, tolerance);
            for moved in &snapped.moved {
                tell(format!("snapped: {moved}"));
            }
            mechanism = snapped.mechanism;
        }
        self.restrict(&mut mechanism)?;
        Ok(mechanism)
    }

    /// The state that takes part, with the external redundancy allowed there.
    ///
    /// # Errors
    /// Where the mechanism has no such state.
    pub fn state(&self, mechanism: &Mechanism) -> Result<Option<(StateId, u32)>, RequestError> {
        let name = || mechanism.name.clone();
        match (&self.state, self.max_external) {
            (None, None) => Ok(None),
            (None, Some(_)) if mechanism.states.len() < 2 => {
                Err(RequestError::OnlyFree { mechanism: name() })
            }
            (None, Some(external)) => Ok(Some((StateId::new(1), external))),
            (Some(state), external) => {
                let Some(s) = mechanism.state(state) else {
                    return Err(RequestError::NoState {
                        mechanism: name(),
                        state: state.clone(),
                        known: mechanism.states.clone(),
                    });
                };
                Ok((s != StateId::FREE).then_some((s, external.unwrap_or(u32::MAX))))
            }
        }
    }

    /// The conditions on the variants of a mechanism that is prepared, and why its geometry looks measured, where it does;
    /// `tell` is warned of that.
    ///
    /// # Errors
    /// Where the mechanism has no such state, and where measured coordinates change the figures, unless the file is to be
    /// taken as written.
    pub fn conditions(
        &self,
        mechanism: &Mechanism,
        tell: &mut dyn FnMut(String),
    ) -> Result<(Conditions, Option<LooksMeasured>), RequestError> {
        let state = self.state(mechanism)?;
        let measured = self.measured(mechanism, state.map(|(s, _)| s), tell)?;
        let tolerance = measured
            .as_ref()
            .map_or(DEFAULT_TOLERANCE, |(m, _)| m.tolerance());
        let conditions = Conditions {
            max_redundant: self.max_redundant,
            state,
            max_mobility: self.max_mobility,
            max_changes: self.max_changes,
            keep_output: !self.allow_output_change,
            symmetry: self.symmetry,
            nodes: self.nodes.clamp(1, u32::MAX as usize / 2),
            tolerance,
        };
        Ok((conditions, measured))
    }

    /// The ranking of the file, with the terms of the request where it names some; `None` where neither asks for one.
    ///
    /// # Errors
    /// Where the pool is none, or too large.
    pub fn ranking(&self, mechanism: &Mechanism) -> Result<Option<Ranking>, RequestError> {
        let mut ranking = mechanism.ranking.clone();
        if !self.rank.is_empty() {
            ranking.get_or_insert_default().terms.clone_from(&self.rank);
        }
        if ranking.is_some() && !(1..=LARGEST_POOL).contains(&self.pool) {
            return Err(RequestError::Pool);
        }
        Ok(ranking)
    }

    /// Whether the geometry looks measured, and if so what exact and tolerant ranks say of the mechanism as it is. Where
    /// they differ the search is refused, unless the file is to be taken as written.
    fn measured(
        &self,
        mechanism: &Mechanism,
        state: Option<StateId>,
        tell: &mut dyn FnMut(String),
    ) -> Result<Option<LooksMeasured>, RequestError> {
        let Some(why) = looks_measured(mechanism) else {
            return Ok(None);
        };
        let fields = [exact_field(mechanism, 0)?, exact_field(mechanism, 1)?];
        let verdicts = std::iter::once(StateId::FREE)
            .chain(state)
            .map(|s| Verdicts::new(&fields, mechanism, s, why.tolerance()))
            .collect::<Result<Vec<_>, _>>()?;
        let name = &mechanism.name;
        let Some(v) = verdicts.iter().find(|v| !v.agree()) else {
            tell(format!(
                "warning: the coordinates of {name} look measured ({why}). Exact and tolerant ranks agree on it as it is, \
                 but the search takes every digit at its word; {CURE}"
            ));
            return Ok(Some((why, verdicts)));
        };
        let (exact, near) = (v.figures(v.exact), v.figures(v.numeric.rank));
        let differ = format!(
            "the coordinates of {name} look measured ({why}), and that matters: as written, state {} has W = {}, σ = {}; \
             to within {:.0e} it has W = {}, σ = {} (smallest singular value kept {:.1e}, largest dropped {:.1e}). \
             Exact ranks take rounding errors for real misalignments",
            v.state,
            exact.0,
            exact.1,
            why.tolerance(),
            near.0,
            near.1,
            v.numeric.kept,
            v.numeric.dropped
        );
        if !self.as_written {
            return Err(RequestError::Measured(differ));
        }
        tell(format!("warning: {differ}; {CURE}"));
        Ok(Some((why, verdicts)))
    }

    /// Holds links, and leaves the options that are allowed.
    fn restrict(&self, mechanism: &mut Mechanism) -> Result<(), RequestError> {
        let name = || mechanism.name.clone();
        let mut held = Vec::with_capacity(self.hold.len());
        for link in &self.hold {
            held.push(mechanism.link(link).ok_or_else(|| RequestError::NoLink {
                mechanism: name(),
                link: link.clone(),
            })?);
        }
        let offered = mechanism.joints.iter().flat_map(|j| &j.options);
        let mut known: Vec<&str> = offered.map(|o| o.name.as_str()).collect();
        known.sort_unstable();
        known.dedup();
        let check = |names: &[String], flag: &'static str| match names
            .iter()
            .find(|n| !known.contains(&n.as_str()))
        {
            None => Ok(()),
            Some(option) => Err(RequestError::NoOption {
                flag,
                mechanism: name(),
                option: option.clone(),
                known: known.iter().map(|k| (*k).to_owned()).collect(),
            }),
        };
        check(&self.options, "--options")?;
        let mut rules: Vec<(JointId, &[String], bool)> = Vec::new();
        for (list, flag) in [(&self.allow, "--allow"), (&self.forbid, "--forbid")] {
            for JointOptions { joint, names } in list {
                let id = mechanism
                    .joint(joint)
                    .ok_or_else(|| RequestError::NoJoint {
                        flag,
                        mechanism: name(),
                        joint: joint.clone(),
                    })?;
                if flag == "--allow" && names.is_empty() {
                    return Err(RequestError::NoNames {
                        joint: joint.clone(),
                    });
                }
                check(names, flag)?;
                rules.push((id, names, flag == "--allow"));
            }
        }
        mechanism.search.hold.extend(held);
        for (id, joint) in mechanism.joint_ids().zip(&mut mechanism.joints) {
            let kept = |name: &String| {
                let mut own = rules.iter().filter(|(j, ..)| *j == id);
                (self.options.is_empty() || self.options.contains(name))
                    && own.all(|(_, names, allow)| {
                        !names.is_empty() && names.contains(name) == *allow
                    })
            };
            let mut place = 0;
            joint.options.retain(|o| {
                place += 1;
                // The present joint stays.
                place == 1 || kept(&o.name)
            });
        }
        Ok(())
    }
}
