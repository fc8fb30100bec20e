//! Whether the lengths of a mechanism are of one order, so that doubles see all of it at once.
//!
//! Poses are closed to a fraction of the mechanism's size, and singular values below another fraction are zero. What a link of
//! a thousand-millionth of that size does is smaller than both: following the motion says nothing of it then.

use crate::closure::twist::FrameValues;
use crate::geom::exact::ExactError;
use crate::geom::extent::Extent;
use crate::geom::scalars::Reals;
use crate::geom::vector::{across, cross, length, sub, unit};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism, StateId};

/// The smallest length that following sees, over the size of the mechanism.
const FINEST: f64 = 1e-5;
/// Directions and points that differ by less are the same.
const SAME: f64 = 1e-12;

/// Returns whether every link between turning joints, every pitch and every ratio of a slide to a turn is long enough to be seen
/// beside the whole mechanism.
///
/// # Errors
/// Where a coordinate has no value.
pub(super) fn are_alike(mechanism: &Mechanism, state: StateId) -> Result<bool, ExactError> {
    let turning: Vec<JointId> = mechanism
        .joints_in(state)
        .filter(|&j| {
            let mut freedoms = mechanism.joints[j].joint_type.freedoms().iter();
            freedoms.any(|f| !f.slides())
        })
        .collect();
    let all = mechanism.joints_in(state);
    let frames = |j: JointId| FrameValues::new(&Reals, &mechanism.joints[j].frame);
    let points = all.map(|j| frames(j).map(|f| f.point));
    let size = Extent::of(&points.collect::<Result<Vec<_>, _>>()?).length;
    let seen = |x: f64| x.abs() <= SAME * size || x.abs() >= FINEST * size;
    for (i, &a) in turning.iter().enumerate() {
        let (of, frame) = (&mechanism.joints[a], frames(a)?);
        if of.joint_type.freedoms().contains(&Freedom::Screw) && !seen(frame.pitch) {
            return Ok(false);
        }
        for &b in &turning[i + 1..] {
            let other = &mechanism.joints[b];
            if !of.links.iter().any(|l| other.links.contains(l)) {
                continue;
            }
            let to = frames(b)?;
            let [z, w] = [frame.axes[2], to.axes[2]].map(unit);
            let apart = sub(to.point, frame.point);
            // Where along parallel axes the points are does not matter.
            let parallel = length(cross(z, w)) <= SAME;
            if !seen(length(if parallel { across(apart, z) } else { apart })) {
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
