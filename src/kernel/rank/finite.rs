//! Finite (full-cycle) mobility: the dimension of the actual motion, as opposed to the instantaneous f - rank J.

pub mod bonds;
pub mod displacement_group;
pub mod higher_order;
pub mod independent_parts;
pub mod local_dimension;
mod mobility;
mod multiplicity;
pub(in crate::rank) mod power_series;
pub(in crate::rank) mod second_order;
pub(in crate::rank) mod tangent_cone;

use crate::closure::Closure;
use crate::geom::Reals;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular::ExactState;
use crate::rank::finite::local_dimension::Traced;
use crate::rank::finite::local_dimension::continuation::lengths_are_alike;
use crate::rank::finite::mobility::{by_ranks, prove_regular};
use crate::rank::finite::multiplicity::{Expanded, are_apart};
use crate::rank::finite::second_order::{Roundings, SecondOrder, mobility_at_singular};
use crate::rank::numeric::scaling::{rank_of_values, scaled_matrix};
use ozols_dense::singular_values;
use std::borrow::Cow;

pub use mobility::{Finite, How, Proof};

/// Work of one closure, rows² · columns, up to which the motion of a pose is followed.
const LARGEST: usize = 30_000_000;
/// Work of all closures together.
const WORK: usize = 5_000_000_000;
/// Units of coordinates, relative to the size, above which shaky poses close like motions. Wren's platform did with
/// eight decimals.
const COARSE: f64 = 2e-9;
/// The same limit for a single motion that has no second-order terms.
const COARSE_ALONE: f64 = 1e-3;
/// Factor of the coarsest unit within which contours with rounded coordinates have to close.
const OPEN: f64 = 4.0;
/// Share of the largest singular value below which a part's value is zero. The geometry of these parts was moved until
/// it was.
const SEPARATE: f64 = 1e-9;
/// Highest order at which coordinates may begin to move if the result of following is to be believed.
const SEEN: usize = 8;
/// Maximum number of closures.
const CLOSINGS: usize = 1_000;

/// Returns the finite mobility of a state. It is proven by groups or by higher order if possible, and followed
/// numerically otherwise. Independent parts are treated separately.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One rank and, if nothing is proven, the closures of [`local_dimension::mobility_by_following`].
pub fn finite_mobility(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
) -> Result<Finite, ExactError> {
    finite_known(exact, mechanism, closure, rank, None)
}

/// Works as [`finite`] for coordinates that may not be exact. The given coordinates are the intended ones.
///
/// # Errors
/// Returns an error in the same cases as [`finite`].
pub(crate) fn finite_known(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
    known: Option<&Roundings>,
) -> Result<Finite, ExactError> {
    let whole = ExactState {
        exact,
        mechanism,
        closure: Cow::Borrowed(closure),
        rank,
    };
    if let Some(known) = by_ranks(&whole)? {
        return Ok(known);
    }
    let state = closure.state;
    let parts = independent_parts::independent_parts(closure);
    let free = independent_parts::count_outside(closure, &parts);
    let mut total = Finite::new(free, How::Rigid);
    for joints in &parts {
        let part = independent_parts::with_joints_only(mechanism, joints);
        let mut own = ExactState::new(exact, &part, state)?;
        if let Some(known) = by_ranks(&own)? {
            total = total.combine_with(known);
            continue;
        }
        let mut locked = part.clone();
        let idle = independent_parts::lock_idle(exact, &mut locked, state)?;
        if idle > 0 {
            total = total.combine_with(Finite::new(idle, How::Rigid));
            own = ExactState::new(exact, &locked, state)?;
        }
        let found = match prove_regular(&own)? {
            Some(known) => known,
            None => {
                let pose = Pose::of_file(own.mechanism, state)?;
                let found = exact_mobility(&own, &pose)?;
                let motions = own.mobility();
                let digits =
                    |known| within_digits(own.mechanism, &pose, motions, Some(found), known);
                known.map_or(found, digits)
            }
        };
        total = total.combine_with(found);
    }
    Ok(total)
}

/// Returns the finite mobility of a part with exact coordinates that ranks do not decide.
fn exact_mobility(at: &ExactState<'_>, pose: &Pose) -> Result<Finite, ExactError> {
    let instantaneous = at.mobility();
    let expanded = Expanded::new(at)?;
    let (series, line) = (expanded.series.as_ref(), expanded.line);
    let isolated = |m: usize| series.and_then(|s| s.isolating_degree(m));
    let stopped = line.and_then(|l| l.stopped);
    let motions = instantaneous;
    let proven = |order| Finite::new(0, How::Stopped { order, motions });
    if let (1, Some(order)) = (instantaneous, stopped) {
        return Ok(proven(order));
    }
    let by = if expanded.is_never_stopped() {
        Some(Proof::Multiplicity)
    } else if stopped.is_none() && are_apart(at)? {
        Some(Proof::Contours)
    } else {
        None
    };
    if let Some(by) = by {
        return Ok(Finite::regular_pose(instantaneous, at.rank, by));
    }
    // If series stop the motion in a random direction, not every first-order motion is finite.
    let shaky = stopped.is_some();
    if !lengths_are_alike(at.exact, at.mechanism, at.closure.state)? {
        let (from, to) = (0, instantaneous - usize::from(shaky));
        return Ok(Finite::between(from, to, How::Undecided));
    }
    if let (Some(series), Some(order)) = (series, stopped)
        && let Some(found) = mobility_at_singular(at, pose, series, order)?
    {
        return Ok(found);
    }
    let Some(mut found) = follow_motion(pose, instantaneous, shaky) else {
        let most = instantaneous - usize::from(shaky);
        return Ok(Finite::between(0, most, How::Bound));
    };
    // A coordinate that begins to move with a high power of the path length pushes with a higher one, if at all, which
    // doubles do not resolve. Then only the upper bound counts.
    if line.is_some_and(|l| l.begun > SEEN) {
        (found.mobility, found.regular) = (0, false);
    }
    if found.regular {
        return Ok(of_pursuit(found));
    }
    Ok(match isolated(instantaneous - found.mobility) {
        Some(order) if found.mobility == 0 => proven(order),
        Some(_) => of_pursuit(Traced {
            at_most: found.mobility,
            ..found
        }),
        None => of_pursuit(found),
    })
}

/// Follows the motion of a pose, unless it is too large.
fn follow_motion(pose: &Pose, instantaneous: usize, shaky: bool) -> Option<Traced> {
    let work = pose.rows() * pose.rows() * pose.columns.len();
    if work > LARGEST {
        return None;
    }
    let budget = (WORK / work.max(1)).clamp(40, CLOSINGS);
    local_dimension::mobility_by_following(pose, instantaneous, shaky, budget)
}

/// Converts the result of following the motion.
fn of_pursuit(found: Traced) -> Finite {
    let how = if found.mobility < found.at_most {
        How::Undecided
    } else {
        How::Traced {
            poses: found.poses,
            regular: found.regular,
        }
    };
    Finite::between(found.mobility, found.at_most, how)
}

/// Returns the finite mobility by following the motion only, or at most `instantaneous` if the mechanism is too large.
/// `accuracy` is the relative error of the coordinates, 0 if they are exact.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::finite::followed_mobility};
/// let bennett = ozols::built_in("bennett")?;
/// let found = followed_mobility(&bennett, StateId::FREE, 1, 0.0)?;
/// assert_eq!((found.mobility, found.is_proven()), (1, false));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn followed_mobility(
    mechanism: &Mechanism,
    state: StateId,
    instantaneous: usize,
    accuracy: f64,
) -> Result<Finite, ExactError> {
    if instantaneous == 0 {
        return Ok(Finite::new(0, How::Rigid));
    }
    let pose = Pose::of_file(mechanism, state)?.with_accuracy(accuracy);
    let found = follow_motion(&pose, instantaneous, false);
    Ok(found.map_or(Finite::between(0, instantaneous, How::Bound), of_pursuit))
}

/// Returns the motion of a part that the rounding of its coordinates leaves open.
///
/// `exact` is the result for the coordinates as given, if these are exact. The motions in it exist, but equal lengths
/// and angles may be lost by rounding. So a motion that it stops counts as stopped only if rounding cannot have caused
/// the obstruction.
fn within_digits(
    mechanism: &Mechanism,
    pose: &Pose,
    instantaneous: usize,
    exact: Option<Finite>,
    known: &Roundings,
) -> Finite {
    let least = exact.map_or(0, |f| f.mobility);
    if let Some(found) = exact
        && (least == instantaneous || found.how == How::Bound)
    {
        return found;
    }
    let second = SecondOrder::new(mechanism, pose, instantaneous, known);
    let most = second.as_ref().map_or(instantaneous, SecondOrder::at_most);
    match exact {
        Some(found) if !found.is_undecided() && least >= most => return found,
        _ if least >= most => {
            let (order, motions) = (2, instantaneous - most);
            return Finite::new(most, How::Stopped { order, motions }).by_numeric_rank();
        }
        _ => {}
    }
    let range = |from| Finite::between(from, most, How::Rounded);
    let coarse = if instantaneous == 1 {
        COARSE_ALONE
    } else {
        COARSE
    };
    // Values that are neither zero nor clearly nonzero decide nothing. The same holds for obstructions that follow from
    // intended relations.
    let stopped = most < instantaneous;
    let may_move = stopped || second.is_some_and(|s| s.may_vanish());
    if exact.is_some() || known.unit > coarse || !may_move {
        return range(least);
    }
    let pose = pose.clone().with_accuracy(OPEN * known.unit);
    match follow_motion(&pose, instantaneous, stopped) {
        Some(found) if found.mobility >= most => of_pursuit(Traced {
            mobility: most,
            at_most: most,
            ..found
        }),
        Some(found) => range(found.mobility),
        None => range(least),
    }
}

/// Returns the motion of a mechanism in doubles that the rounding of its coordinates leaves open.
///
/// # Errors
/// Returns an error if a coordinate has no value.
pub(super) fn mobility_within(
    mechanism: &Mechanism,
    state: StateId,
    instantaneous: usize,
    known: &Roundings,
) -> Result<Finite, ExactError> {
    let Some(parts) = numeric_parts(mechanism, state).filter(|(free, parts)| {
        parts.len() > 1 && free + parts.iter().map(|p| p.1).sum::<usize>() == instantaneous
    }) else {
        return whole_within(mechanism, state, instantaneous, known);
    };
    let mut total = Finite::new(parts.0, How::Rigid);
    for (part, instantaneous) in &parts.1 {
        total = total.combine_with(whole_within(part, state, *instantaneous, known)?);
    }
    Ok(total)
}

/// Freedoms of joints in no contour, and the parts with their instantaneous mobilities.
type Parts = (usize, Vec<(Mechanism, usize)>);

/// Returns the independent parts of a mechanism in doubles.
fn numeric_parts(mechanism: &Mechanism, state: StateId) -> Option<Parts> {
    let closure = Closure::new(&Reals, mechanism, state).ok()?;
    let parts = independent_parts::independent_parts(&closure);
    let free = independent_parts::count_outside(&closure, &parts);
    let each = parts.iter().map(|joints| {
        let part = independent_parts::with_joints_only(mechanism, joints);
        numeric_mobility(&part, state).map(|w| (part, w))
    });
    Some((free, each.collect::<Option<_>>()?))
}

/// Returns the instantaneous mobility of a mechanism in doubles whose geometry was moved until it has that mobility.
fn numeric_mobility(mechanism: &Mechanism, state: StateId) -> Option<usize> {
    let own = Closure::new(&Reals, mechanism, state).ok()?;
    let values = singular_values(&scaled_matrix(&own))?;
    Some(own.columns.len() - rank_of_values(values, SEPARATE).rank)
}

/// Applies [`within`] to one part.
fn whole_within(
    mechanism: &Mechanism,
    state: StateId,
    instantaneous: usize,
    known: &Roundings,
) -> Result<Finite, ExactError> {
    // A rod between two balls spins in any position, whatever the digits. An exactly locked freedom may remove this
    // spin only because of rounding, if the rod lies almost along a plane of the ball's axes. So the numeric mobility
    // is compared.
    let mut locked = mechanism.clone();
    let idle = field_of(mechanism, state, 0)
        .ok()
        .and_then(|exact| independent_parts::lock_idle(&exact, &mut locked, state).ok())
        .filter(|&idle| {
            idle > 0 && numeric_mobility(&locked, state) == instantaneous.checked_sub(idle)
        });
    let (part, idle) = idle.map_or((mechanism, 0), |idle| (&locked, idle));
    let left = instantaneous - idle;
    let spins = Finite::new(idle, How::Rigid).by_numeric_rank();
    if left == 0 {
        return Ok(spins);
    }
    let pose = Pose::of_file(part, state)?;
    Ok(spins.combine_with(within_digits(part, &pose, left, None, known)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{draw_mechanism, hinges};
    use crate::model::rounded::Uncertainties;

    /// Two motions of a ring of five hinges exist. Digits too coarse to show what stops a shaky pose cannot distinguish
    /// it from these.
    #[test]
    fn of_coarse_digits_two_motions_are_not_told_from_shaky_ones() {
        let ring = [
            [0.0, 0.0, 0.0],
            [1.0, 4.0, 0.0],
            [5.0, 7.0, 0.0],
            [9.0, 5.0, 0.0],
            [8.0, 1.0, 0.0],
        ];
        let at = |i: usize| ([i, (i + 1) % 5], ring[i]);
        let m = draw_mechanism(&hinges(&(0..5).map(at).collect::<Vec<_>>()), &[]);
        let found = |unit: f64| {
            let half = Uncertainties::uniform(&m, unit / 2.0, unit / 2.0);
            mobility_within(&m, StateId::FREE, 2, &Roundings::new(&m, half, 1.0)).unwrap()
        };
        let fine = found(1e-12);
        assert_eq!((fine.mobility, fine.at_most()), (2, 2));
        let coarse = found(1e-2);
        assert_eq!((coarse.how, coarse.at_most()), (How::Rounded, 2));
    }
}
