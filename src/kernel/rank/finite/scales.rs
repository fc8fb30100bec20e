//! Tests whether the lengths of a mechanism are of one order of magnitude, so that doubles resolve all of it at once.
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

/// The smallest length that following resolves, relative to the size of the mechanism.
const FINEST: f64 = 1e-5;

/// Returns true if every length is large enough to be resolved relative to the whole mechanism: links between turning
/// joints, pitches, and ratios of a slide to a turn. Exact zeros do not count as lengths.
///
/// # Errors
/// Returns an error if a coordinate has no value.
pub(super) fn are_alike(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
) -> Result<bool, ExactError> {
    let turning: Vec<JointId> = mechanism
        .joints_in(state)
        .filter(|&j| {
            let mut freedoms = mechanism.joints[j].joint_type.freedoms().iter();
            freedoms.any(|f| !f.slides())
        })
        .collect();
    let all = mechanism.joints_in(state);
    let frames = |j: JointId| FrameValues::new(&Reals, &mechanism.joints[j].frame);
    let residues = |j: JointId| FrameValues::new(exact, &mechanism.joints[j].frame);
    let points = all.map(|j| frames(j).map(|f| f.point));
    let size = Extent::of(&points.collect::<Result<Vec<_>, _>>()?).length;
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
            let distance = match separation(exact, &exactly, &there) {
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
        match c.ends.map(|e| e.freedom.slides()) {
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
fn separation(
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
