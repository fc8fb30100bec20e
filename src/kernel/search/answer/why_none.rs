//! If a question has no answer: the conditions that would leave some variants if one of them were eased.

use crate::closure::Closure;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{JointId, StateId};
use crate::redundancy::motion::motion_basis;
use crate::search::answer::counts::Counts;
use crate::search::check::brute::Matrices;
use crate::search::diagram::{Control, ShouldCancel, Stop};
use crate::search::question::Question;
use crate::search::question::conditions::{Conditions, InState, SearchError};
use crate::search::question::kept::Drives;
use crate::search::solve::build_diagrams;
use num_bigint::BigUint;
use num_traits::Zero;

/// A condition eased, by the least that leaves variants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relaxation {
    /// Redundant constraints within the mechanism up to this many.
    Redundant(u32),
    /// Redundant constraints that the state adds up to this many.
    External(u32),
    /// Mobility up to this.
    Mobility(i64),
    /// Up to this many changes.
    Changes(u32),
    /// Harmful ones among them up to this many.
    Harmful(u32),
    /// Outputs that move in other ways than now.
    OutputChange,
    /// Drives that may move without the outputs.
    FreeDrives,
    /// Objects that are not held.
    LooseObject,
    /// The motion in the drawn pose only.
    PoseOnly,
}

/// Reasons why no choice can give a result.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Hopeless {
    /// Redundant constraints that remain if every joint has all freedoms of its options, if these are more than allowed.
    pub least_redundant: Option<usize>,
    /// Joints that have no choice, and of which a freer one would remove some of these.
    pub unchanged: Vec<JointId>,
    /// Driven joints that do not move in the present mechanism.
    pub frozen: Vec<JointId>,
}

/// Maximum number of nodes of a diagram if the question took fewer: easing should cost little more than the question did.
const NODES: usize = 20_000;
/// How many times the question's nodes, where those are more.
const MORE: usize = 4;

/// Returns the reasons why no variant can be found.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
pub fn find_obstacles(question: &Question) -> Result<Hopeless, ExactError> {
    let m = &*question.mechanism;
    let (least, unchanged) = Matrices::new(question).freest_redundancy();
    let most = usize::try_from(question.conditions.max_redundant).unwrap_or(usize::MAX);
    let closure = Closure::new(&question.exact, m, StateId::FREE)?;
    let kernel = motion_basis(&question.exact, &closure);
    let moves = |j: JointId| {
        let columns = closure.columns.iter().enumerate();
        let mut own = columns.filter(|(_, c)| c.joint == j);
        own.any(|(at, _)| kernel.iter().any(|speeds| speeds[at] != 0))
    };
    let driven = m.joints_in(StateId::FREE).filter(|&j| m.joints[j].drive);
    Ok(Hopeless {
        frozen: driven.filter(|&j| !moves(j)).collect(),
        least_redundant: (least > most).then_some(least),
        unchanged: if least > most { unchanged } else { Vec::new() },
    })
}

/// Returns the conditions that leave some variants if each is relaxed on its own, with the number of variants. Skips a
/// condition whose search would take too many nodes. `nodes` is the number that the question took.
///
/// # Errors
/// Returns an error in the same cases as [`Question::new`].
///
/// # Complexity
/// One search for each condition. For redundant constraints, one or two for each bit of the smallest number that is enough.
pub fn find_relaxations(
    question: &Question,
    nodes: usize,
    cancelled: ShouldCancel<'_>,
) -> Result<Vec<(Relaxation, BigUint)>, SearchError> {
    let conditions = &question.conditions;
    let easing = Easing {
        question,
        nodes: nodes.saturating_mul(MORE).max(NODES),
        cancelled,
    };
    let state = conditions.state;
    let mut out = easing.ease_bounds()?;
    let mut ease = |is_asked: bool, change: Change<'_>, found: &dyn Fn(Counts) -> Found| {
        if is_asked && let Some(c) = easing.count_eased(change)?.filter(|c| !c.total.is_zero()) {
            out.extend(found(c));
        }
        Ok::<_, SearchError>(())
    };
    ease(
        state.is_some_and(|s| s.hold_objects),
        &|c| in_state(c, &|s| s.hold_objects = false),
        &|c| Some((Relaxation::LooseObject, c.total)),
    )?;
    ease(
        conditions.max_mobility.is_some(),
        &|c| c.max_mobility = None,
        &|mut c| {
            c.by_mobility
                .pop_first()
                .map(|(w, n)| (Relaxation::Mobility(w), n))
        },
    )?;
    ease(
        conditions.max_changes.is_some(),
        &|c| c.max_changes = None,
        &|mut c| {
            c.by_changes
                .pop_first()
                .map(|(k, n)| (Relaxation::Changes(k), n))
        },
    )?;
    ease(
        !question.mechanism.search.drives.is_empty(),
        &|c| c.drives = Drives::Free,
        &|c| Some((Relaxation::FreeDrives, c.total)),
    )?;
    ease(
        conditions.keep_output,
        &|c| (c.keep_output, c.drives) = (false, Drives::Free),
        &|c| Some((Relaxation::OutputChange, c.total)),
    )?;
    Ok(out)
}

/// An eased condition, and what it leaves.
type Found = Option<(Relaxation, BigUint)>;
/// How conditions are eased.
type Change<'a> = &'a dyn Fn(&mut Conditions);

/// Applies a change to the conditions in the searched state, if there is one.
fn in_state(conditions: &mut Conditions, change: &dyn Fn(&mut InState)) {
    conditions.state.iter_mut().for_each(change);
}

/// A question that is asked again with conditions eased.
struct Easing<'a> {
    question: &'a Question,
    /// Maximum number of nodes of a diagram.
    nodes: usize,
    cancelled: ShouldCancel<'a>,
}

impl Easing<'_> {
    /// Returns the counts under other conditions; `None` if it takes too many nodes.
    fn count_eased(&self, change: Change<'_>) -> Result<Option<Counts>, SearchError> {
        let question = self.question;
        let mut eased = question.conditions.clone();
        eased.nodes = eased.nodes.min(self.nodes);
        (eased.cheapest, eased.counted, eased.estimate) = (0, true, None);
        change(&mut eased);
        let other = Question::new(question.exact.clone(), question.mechanism.clone(), eased)?;
        let built = build_diagrams(&other, Control::cancelled_by(self.cancelled));
        let whole = built.stop_reason() == Stop::Exhausted;
        Ok(whole.then(|| other.count_variants(built.listed_diagram(), true)))
    }

    /// Returns bounds beyond what is allowed. Diagrams grow with them, so the first is only a little larger. Each step is
    /// twice the one before, until the search takes too many nodes.
    fn further_bounds(&self, allowed: u32) -> impl Iterator<Item = u32> {
        // No variant has more redundant constraints than rows.
        let rows = u32::try_from(6 * self.question.mechanism.joints.len()).unwrap_or(u32::MAX);
        let more = std::iter::successors(Some(1u32), |m| m.checked_mul(2));
        let bounds = more.map(move |m| allowed.saturating_add(m));
        bounds.take_while(move |b| *b < 2 * rows)
    }

    /// Returns the least sufficient bounds of redundant constraints: within the mechanism, added by the searched state, and harmful.
    fn ease_bounds(&self) -> Result<Vec<(Relaxation, BigUint)>, SearchError> {
        let Question {
            conditions,
            mechanism,
            ..
        } = self.question;
        // Independent drives are not searched with redundant constraints left.
        let within = (!mechanism.search.locks_drives).then_some(conditions.max_redundant);
        let external = conditions.state.and_then(|s| s.max_external);
        let harmful = conditions.state.and_then(|s| s.max_harmful);
        let found = [
            self.least_bound(within, Relaxation::Redundant, &|c, n| c.max_redundant = n)?,
            self.least_bound(external, Relaxation::External, &|c, n| {
                in_state(c, &|s| s.max_external = Some(n));
            })?,
            self.least_bound(harmful, Relaxation::Harmful, &|c, n| {
                in_state(c, &|s| s.max_harmful = Some(n));
            })?,
        ];
        Ok(found.into_iter().flatten().collect())
    }

    /// Returns the least sufficient bound beyond the one that is allowed, with the number of variants. The bound is doubled, then the gap is
    /// halved.
    fn least_bound(
        &self,
        allowed: Option<u32>,
        how: fn(u32) -> Relaxation,
        set: &dyn Fn(&mut Conditions, u32),
    ) -> Result<Found, SearchError> {
        let with = |most: u32| self.count_eased(&|c| set(c, most));
        let Some(mut few) = allowed else {
            return Ok(None);
        };
        for bound in self.further_bounds(few) {
            let Some(mut found) = with(bound)? else {
                break;
            };
            if found.total.is_zero() {
                few = bound;
                continue;
            }
            let mut enough = bound;
            // Counts tell how many redundant constraints are left within the mechanism.
            if let (Relaxation::Redundant(_), Some((least, n))) =
                (how(bound), found.by_redundant.first_key_value())
            {
                return Ok(Some((how(*least), n.clone())));
            }
            while enough - few > 1 {
                let middle = few + (enough - few) / 2;
                match with(middle)?.filter(|c| !c.total.is_zero()) {
                    Some(c) => (enough, found) = (middle, c),
                    None => few = middle,
                }
            }
            return Ok(Some((how(enough), found.total)));
        }
        Ok(None)
    }
}
