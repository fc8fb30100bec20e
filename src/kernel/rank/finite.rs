//! Finite (full-cycle) mobility: the dimension of the motion that is really there, beside the instantaneous f - rank J.

pub mod at_rest;
pub mod bonds;
mod contours;
pub mod displacement_group;
pub mod higher_order;
mod idle_ways;
pub mod independent_parts;
pub mod local_dimension;
mod mobility;
mod multiplicity;
mod never_stopped;
pub(in crate::rank) mod power_series;
mod regular;
mod scales;
pub(in crate::rank) mod second_order;
mod singular;
pub(in crate::rank) mod tangent_cone;

use crate::closure::Closure;
use crate::geom::Reals;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::finite::local_dimension::Traced;
use crate::rank::finite::never_stopped::Expanded;
use crate::rank::finite::regular::{by_ranks, regular};
use crate::rank::finite::second_order::{Roundings, SecondOrder};
use crate::rank::numeric::scaling::{rank_of_values, scaled};
use ozols_dense::singular_values;

pub use mobility::{Finite, How, Proof};

/// Work of one closing, rows² · columns, up to which a pose is followed at all.
const LARGEST: usize = 30_000_000;
/// Work of all closings together.
const WORK: usize = 5_000_000_000;
/// Units of coordinates, relative to the size, above which shaky poses close like motions: Wren's platform did with eight decimals.
const COARSE: f64 = 2e-9;
/// The same where one motion alone is in question, of which nothing of second order is left.
const COARSE_ALONE: f64 = 1e-3;
/// Contours of rounded coordinates need not close better than this many times the coarsest unit.
const OPEN: f64 = 4.0;
/// Singular values of parts below this share of the largest are zero: their geometry was moved until they were.
const SEPARATE: f64 = 1e-9;
/// Orders up to which coordinates may begin to move for following to be believed.
const SEEN: usize = 8;
/// Closings at most.
const CLOSINGS: usize = 1_000;

/// The finite mobility of a state: proven by groups or by higher order where that works, followed numerically where not;
/// part by part where the mechanism falls into parts.
///
/// # Errors
/// Where a coordinate has no value in the field.
///
/// # Complexity
/// One rank, and where nothing is proven the closings of [`local_dimension::mobility`].
pub fn finite(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
) -> Result<Finite, ExactError> {
    finite_known(exact, mechanism, closure, rank, None)
}

/// [`finite`] for coordinates that may not be exact: as they are given, they are those that are meant.
///
/// # Errors
/// As [`finite`].
pub(crate) fn finite_known(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
    known: Option<&Roundings>,
) -> Result<Finite, ExactError> {
    if let Some(known) = by_ranks(exact, mechanism, closure, rank)? {
        return Ok(known);
    }
    let state = closure.state;
    let parts = independent_parts::parts(closure);
    // Joints in no contour move as they like.
    let inside = |j: JointId| parts.iter().any(|p| p.contains(&j));
    let free = closure.columns.iter().filter(|c| !inside(c.joint)).count();
    let mut total = Finite::new(free, How::Rigid);
    for joints in &parts {
        let mut part = independent_parts::alone(mechanism, joints);
        let mut own = Closure::new(exact, &part, state)?;
        let mut rank = modular::rank(exact, &own);
        if let Some(known) = by_ranks(exact, &part, &own, rank)? {
            total = total.and(known);
            continue;
        }
        let idle = independent_parts::lock_idle(exact, &mut part, state)?;
        if idle > 0 {
            total.mobility += idle;
            own = Closure::new(exact, &part, state)?;
            rank = modular::rank(exact, &own);
        }
        let found = match regular(exact, &part, &own, rank)? {
            Some(known) => known,
            None => moved(exact, &part, &own, rank, known)?,
        };
        total = total.and(found);
    }
    Ok(total)
}

/// A part whose motion ranks do not decide: by higher order, and by going there.
fn moved(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
    known: Option<&Roundings>,
) -> Result<Finite, ExactError> {
    let pose = Pose::of_file(mechanism, closure.state)?;
    let found = exactly(exact, mechanism, closure, rank, &pose)?;
    let instantaneous = closure.columns.len() - rank;
    Ok(match known {
        Some(known) => within_digits(mechanism, &pose, instantaneous, Some(found), known),
        None => found,
    })
}

/// A part whose motion ranks do not decide and whose coordinates are exact.
fn exactly(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
    pose: &Pose,
) -> Result<Finite, ExactError> {
    let instantaneous = closure.columns.len() - rank;
    let expanded = Expanded::new(exact, mechanism, closure, pose, rank)?;
    let (series, line) = (expanded.series.as_ref(), expanded.line);
    let isolated = |m: usize| series.and_then(|s| s.isolated(m));
    let stopped = line.and_then(|l| l.stopped);
    let proven = |order| nothing_moves(order, instantaneous);
    if let (1, Some(order)) = (instantaneous, stopped) {
        return Ok(proven(order));
    }
    let by = if expanded.is_never_stopped() {
        Some(Proof::Multiplicity)
    } else if stopped.is_none() && contours::are_apart(exact, mechanism, closure, rank)? {
        Some(Proof::Contours)
    } else {
        None
    };
    if let Some(by) = by {
        return Ok(Finite::new(
            instantaneous,
            How::Submersion {
                dimension: rank,
                by,
            },
        ));
    }
    // Not everything that moves at first order moves, where series stop it in a random direction.
    let shaky = stopped.is_some();
    if !scales::are_alike(exact, mechanism, closure.state)? {
        let (from, to) = (0, instantaneous - usize::from(shaky));
        return Ok(Finite::new(from, How::Undecided { from, to }));
    }
    if let (Some(series), Some(order)) = (series, stopped)
        && let Some(found) = singular::passed(exact, mechanism, closure, rank, pose, series, order)?
    {
        return Ok(found);
    }
    let Some(found) = pursued(pose, instantaneous, shaky) else {
        return Ok(too_large(instantaneous - usize::from(shaky)));
    };
    // What begins to move with a high power of the way pushes, if at all, with one that doubles do not see.
    let seen = line.is_none_or(|l| l.begun <= SEEN);
    let found = if seen { found } else { unseen(found) };
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

/// What is proven where all of so many instantaneous motions are stopped.
fn nothing_moves(order: usize, motions: usize) -> Finite {
    Finite::new(0, How::Stopped { order, motions })
}

/// Follows the motion of a pose, where it is not too large for that.
fn pursued(pose: &Pose, instantaneous: usize, shaky: bool) -> Option<Traced> {
    let work = pose.rows() * pose.rows() * pose.columns.len();
    if work > LARGEST {
        return None;
    }
    let budget = (WORK / work.max(1)).clamp(40, CLOSINGS);
    local_dimension::mobility(pose, instantaneous, shaky, budget)
}

/// What following shows where gaps may be too small to be seen: no more than what is excluded.
fn unseen(found: Traced) -> Traced {
    Traced {
        mobility: 0,
        regular: false,
        ..found
    }
}

/// What is not followed: at most what moves instantaneously.
fn too_large(to: usize) -> Finite {
    Finite::new(0, How::Bound { to })
}

/// What following the motion says.
fn of_pursuit(found: Traced) -> Finite {
    let (from, to) = (found.mobility, found.at_most);
    let how = if from < to {
        How::Undecided { from, to }
    } else {
        How::Traced {
            poses: found.poses,
            regular: found.regular,
        }
    };
    Finite::new(from, how)
}

/// The finite mobility by following the motion alone; at most `instantaneous` where it is too large for that. `accuracy` is the
/// relative error of the coordinates, 0 where they are exact.
///
/// # Errors
/// Where a coordinate has no value.
pub fn followed(
    mechanism: &Mechanism,
    state: StateId,
    instantaneous: usize,
    accuracy: f64,
) -> Result<Finite, ExactError> {
    if instantaneous == 0 {
        return Ok(Finite::new(0, How::Rigid));
    }
    let pose = Pose::of_file(mechanism, state)?.with_accuracy(accuracy);
    let found = pursued(&pose, instantaneous, false);
    Ok(found.map_or(too_large(instantaneous), of_pursuit))
}

/// What the digits of a part leave of its motion. `exact` is what holds of the coordinates as they are given, where these are exact:
/// its motions are there, but equal lengths and angles may be lost, so what it stops is stopped only where the digits cannot
/// have made what stops it.
fn within_digits(
    mechanism: &Mechanism,
    pose: &Pose,
    instantaneous: usize,
    exact: Option<Finite>,
    known: &Roundings,
) -> Finite {
    let least = exact.map_or(0, |f| f.mobility);
    if let Some(found) = exact
        && (least == instantaneous || matches!(found.how, How::Bound { .. }))
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
    let range = |from| Finite::new(from, How::Rounded { to: most });
    let coarse = if instantaneous == 1 {
        COARSE_ALONE
    } else {
        COARSE
    };
    // What is neither zero nor clearly not says nothing, nor does what is stopped by relations that the digits mean.
    let stopped = most < instantaneous;
    let may_move = stopped || second.is_some_and(|s| s.may_vanish());
    if exact.is_some() || known.unit > coarse || !may_move {
        return range(least);
    }
    let pose = pose.clone().with_accuracy(OPEN * known.unit);
    match pursued(&pose, instantaneous, stopped) {
        Some(found) if found.mobility >= most => of_pursuit(Traced {
            mobility: most,
            at_most: most,
            ..found
        }),
        Some(found) => range(found.mobility),
        None => range(least),
    }
}

/// What the digits leave of the motion of a mechanism in doubles.
///
/// # Errors
/// Where a coordinate has no value.
pub(super) fn within(
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
        total = total.and(whole_within(part, state, *instantaneous, known)?);
    }
    Ok(total)
}

/// Freedoms of joints in no contour, and the parts with their instantaneous mobilities.
type Parts = (usize, Vec<(Mechanism, usize)>);

/// The parts that a mechanism in doubles falls into.
fn numeric_parts(mechanism: &Mechanism, state: StateId) -> Option<Parts> {
    let closure = Closure::new(&Reals, mechanism, state).ok()?;
    let parts = independent_parts::parts(&closure);
    let inside = |j: JointId| parts.iter().any(|p| p.contains(&j));
    let free = closure.columns.iter().filter(|c| !inside(c.joint)).count();
    let each = parts.iter().map(|joints| {
        let part = independent_parts::alone(mechanism, joints);
        numeric_mobility(&part, state).map(|w| (part, w))
    });
    Some((free, each.collect::<Option<_>>()?))
}

/// The instantaneous mobility of a mechanism in doubles whose geometry was moved until it has it.
fn numeric_mobility(mechanism: &Mechanism, state: StateId) -> Option<usize> {
    let own = Closure::new(&Reals, mechanism, state).ok()?;
    let values = singular_values(&scaled(&own))?;
    Some(own.columns.len() - rank_of_values(values, SEPARATE).rank)
}

/// [`within`] of one part.
fn whole_within(
    mechanism: &Mechanism,
    state: StateId,
    instantaneous: usize,
    known: &Roundings,
) -> Result<Finite, ExactError> {
    // A rod between two balls spins wherever they are, whatever the digits. What is locked of it exactly may be left by rounding
    // alone, where the rod lies all but along a plane of the ball's axes.
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
    Ok(spins.and(within_digits(part, &pose, left, None, known)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{drawn, hinges};
    use crate::model::rounded::Uncertainties;

    /// Two motions of a ring of five hinges are there; but digits that would hide what stops a shaky pose do not tell that one.
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
        let m = drawn(&hinges(&(0..5).map(at).collect::<Vec<_>>()), &[]);
        let found = |unit: f64| {
            let half = Uncertainties::uniform(&m, unit / 2.0, unit / 2.0);
            within(&m, StateId::FREE, 2, &Roundings::new(&m, half, 1.0)).unwrap()
        };
        let fine = found(1e-12);
        assert_eq!((fine.mobility, fine.at_most()), (2, 2));
        let coarse = found(1e-2);
        assert_eq!((coarse.how, coarse.at_most()), (How::Rounded { to: 2 }, 2));
    }
}
