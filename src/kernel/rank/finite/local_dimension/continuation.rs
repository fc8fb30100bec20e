//! Tests whether a motion continues, up to distances at which shaky poses show a gap.
//!
//! A shaky pose of order n leaves a gap that grows with the nth power of the path length. For order 32 it is 10^-23 at
//! a fifth of a radian, which no double resolves. At a radian and more, all orders are visible. So a motion is followed
//! by predictor and corrector [Allgower & Georg 1990, ch. 2] until some coordinate has gone that far. It may pass dead
//! points and turn back on the way. Coordinates are measured from one pose, so that gaps do not accumulate unseen.
//!
//! Poses are closed to a fraction of the mechanism's size, and singular values below another fraction are zero. The
//! effect of a link of a thousand-millionth of that size is smaller than both. Following the motion gives no
//! information about it.

use crate::closure::twist::FrameValues;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::extent::Extent;
use crate::geom::vector::{across, length, sub, unit};
use crate::geom::{Reals, Scalars};
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::finite::local_dimension::DimensionSearch;
use ozols_dense::{Matrix, add_scaled, difference, dot, largest_entry, norm, svd};

/// Distance that a motion must cover, by the coordinate that moves most from step to step: radians, or fractions of the
/// size.
const REACH: f64 = 2.0;
/// The longest step.
const LONGEST: f64 = 0.12;
/// Minimum step length.
const SHORTEST: f64 = 0.004;
/// The largest correction, as a share of its step.
const CORRECTION: f64 = 0.5;
/// Minimum share of an end point in a direction to count as leading there. Motions stopped by a high order are off by
/// at most a tenth.
const APART: f64 = 0.3;
/// Number of directions tried from a pose before it counts as isolated.
const TRIES: usize = 3;

impl DimensionSearch {
    /// Returns whether a motion in a random direction of some orthonormal columns, all being motions, continues. With
    /// `apart`, returns whether [all of them do](Self::lead_apart). Returns `None` if the budget is spent.
    pub(super) fn all_go_on(&mut self, pose: &Pose, span: &Matrix, apart: bool) -> Option<bool> {
        let n = span.ncols();
        if apart && n > 1 {
            return self.lead_apart(pose, span);
        }
        let here = vec![0.0; span.nrows()];
        for _ in 0..TRIES {
            let direction = span.combine_columns(&self.random_direction(n));
            if self.goes_on(pose, &here, &direction, n)? {
                return Some(true);
            }
        }
        Some(false)
    }

    /// Returns whether motions in random directions of some orthonormal columns continue and lead to coordinates in as
    /// many independent directions. A stopped motion turns into one of the others along the path. Returns `None` if the
    /// budget is spent.
    fn lead_apart(&mut self, pose: &Pose, span: &Matrix) -> Option<bool> {
        let n = span.ncols();
        let here = vec![0.0; span.nrows()];
        let mut ends: Vec<Vec<f64>> = Vec::new();
        for _ in 0..TRIES * n {
            let direction = span.combine_columns(&self.random_direction(n));
            let Some(end) = self.end_of(pose, &here, &direction, n)? else {
                continue;
            };
            let size = norm(&end).max(1e-300);
            ends.push(end.into_iter().map(|x| x / size).collect());
            let all = Matrix::from_fn(span.nrows(), ends.len(), |r, c| ends[c][r]);
            if svd(&all).is_some_and(|svd| svd.rank(APART) == n) {
                return Some(true);
            }
        }
        Some(false)
    }

    /// Returns whether a motion continues from closed coordinates in a direction, with J leaving at least `least`
    /// motions all along it. Returns `None` if the budget is spent.
    ///
    /// # Complexity
    /// About twenty closures and as many decompositions of J.
    pub(super) fn goes_on(
        &mut self,
        pose: &Pose,
        from: &[f64],
        direction: &[f64],
        least: usize,
    ) -> Option<bool> {
        Some(self.end_of(pose, from, direction, least)?.is_some())
    }

    /// Returns the end point of a motion that continues as [`Self::goes_on`] requires. The inner `None` means that it
    /// does not.
    fn end_of(
        &mut self,
        pose: &Pose,
        from: &[f64],
        direction: &[f64],
        least: usize,
    ) -> Option<Option<Vec<f64>>> {
        let (mut q, mut onward) = (from.to_vec(), direction.to_vec());
        let (mut way, mut step) = (0.0, LONGEST);
        while way < REACH {
            let Some(tangent) = nearest_motion(pose, &q, &onward, least) else {
                return Some(None);
            };
            let next = loop {
                let guess = add_scaled(&q, step, &tangent);
                // This equation only fixes the step along the tangent. Everything else is corrected as little as
                // possible.
                let size = norm(&tangent);
                let row: Vec<f64> = tangent.iter().map(|t| t / size).collect();
                let beside = |x: &[f64]| vec![(dot(&difference(x, &guess), &row), row.clone())];
                let (closed, gap) = self.close_near(pose, guess.clone(), &beside)?;
                let corrected = difference(&closed, &guess);
                if gap <= pose.closed_tolerance() && largest_entry(&corrected) <= CORRECTION * step
                {
                    break closed;
                }
                step /= 2.0;
                if step < SHORTEST {
                    return Some(None);
                }
            };
            onward = difference(&next, &q);
            way += step;
            step = (1.5 * step).min(LONGEST);
            q = next;
        }
        Some(nearest_motion(pose, &q, &onward, least).map(|_| q))
    }
}

/// Returns the motion at some coordinates that is nearest to a direction, scaled to a largest coordinate of 1. Returns
/// `None` if J leaves fewer than `least` motions.
fn nearest_motion(pose: &Pose, q: &[f64], onward: &[f64], least: usize) -> Option<Vec<f64>> {
    let svd = svd(&pose.jacobian_at(q))?;
    let scale = svd.values.first().map_or(1.0, |s| s.max(1.0));
    let flat = FLAT.max(10.0 * pose.accuracy()) * scale;
    let kernel = svd.null_space(svd.values.iter().filter(|&&s| s > flat).count());
    if kernel.ncols() < least {
        return None;
    }
    let weights: Vec<f64> = (0..kernel.ncols())
        .map(|c| dot(kernel.col(c), onward))
        .collect();
    let tangent = kernel.combine_columns(&weights);
    let size = largest_entry(&tangent);
    (norm(&weights) > 0.0 && size > 0.0).then(|| tangent.iter().map(|t| t / size).collect())
}

/// The smallest length that following resolves, relative to the size of the mechanism.
const FINEST: f64 = 1e-5;

/// Returns true if every length is large enough to be resolved relative to the whole mechanism: links between turning
/// joints, pitches, and ratios of a slide to a turn. Exact zeros do not count as lengths.
///
/// # Errors
/// Returns an error if a coordinate has no value.
pub(in crate::rank::finite) fn lengths_are_alike(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
) -> Result<bool, ExactError> {
    let turning: Vec<JointId> = mechanism
        .joints_in(state)
        .filter(|&j| {
            let mut freedoms = mechanism.joints[j].joint_type.freedoms().iter();
            freedoms.any(|f| !f.is_slide())
        })
        .collect();
    let all = mechanism.joints_in(state);
    let frames = |j: JointId| FrameValues::new(&Reals, &mechanism.joints[j].frame);
    let residues = |j: JointId| FrameValues::new(exact, &mechanism.joints[j].frame);
    let points = all.map(|j| frames(j).map(|f| f.point));
    let size = Extent::from_points(&points.collect::<Result<Vec<_>, _>>()?).length;
    let seen = |x: f64| x.abs() >= FINEST * size;
    for (i, &a) in turning.iter().enumerate() {
        let (of, frame, exactly) = (&mechanism.joints[a], frames(a)?, residues(a)?);
        let screws = of.joint_type.freedoms().contains(&Freedom::Screw);
        if screws && exactly.pitch != 0 && !seen(frame.pitch) {
            return Ok(false);
        }
        for &b in &turning[i + 1..] {
            let other = &mechanism.joints[b];
            if !of.links.iter().any(|l| other.links.contains(l)) {
                continue;
            }
            let (to, there) = (frames(b)?, residues(b)?);
            let apart = sub(to.point, frame.point);
            // The position of the points along parallel axes does not matter.
            let distance = match separation_of(exact, &exactly, &there) {
                Separation::None => continue,
                Separation::OfParallelAxes => length(across(apart, unit(frame.axes[2]))),
                Separation::OfPoints => length(apart),
            };
            if !seen(distance) {
                return Ok(false);
            }
        }
    }
    Ok(mechanism.couplings_in(state).all(|c| {
        let ratio = c.ratio.to_f64();
        match c.ends.map(|e| e.freedom.is_slide()) {
            [false, true] => seen(ratio),
            [true, false] => seen(1.0 / ratio),
            _ => (FINEST..1.0 / FINEST).contains(&ratio.abs()),
        }
    }))
}

/// Separation of two joints.
enum Separation {
    /// One axis, or one point.
    None,
    OfParallelAxes,
    OfPoints,
}

/// Returns the separation of two joints, by exact arithmetic. Doubles cannot distinguish a small length from zero.
fn separation_of(
    exact: &ExactField,
    a: &FrameValues<Residue>,
    b: &FrameValues<Residue>,
) -> Separation {
    let apart: [Residue; 3] = std::array::from_fn(|i| exact.sub(b.point[i], a.point[i]));
    if exact.cross(a.axes[2], b.axes[2]) != [0; 3] {
        return if apart == [0; 3] {
            Separation::None
        } else {
            Separation::OfPoints
        };
    }
    if exact.cross(apart, a.axes[2]) == [0; 3] {
        Separation::None
    } else {
        Separation::OfParallelAxes
    }
}
