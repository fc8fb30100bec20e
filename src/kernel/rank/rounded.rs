//! Rounded coordinates: the geometry they intend, and whether the digits determine the rank.

pub mod nearest_lower_rank;
pub mod nearly_special;
pub mod verdict;

use crate::closure::twist::FrameValues;
use crate::geom::Reals;
use crate::geom::extent::Extent;
use crate::geom::vector::{Vector, length, to_vector};
use crate::model::mechanism::{JointId, Mechanism, Mode};
use crate::model::rounded::Uncertainties;

/// Returns the reference size of a mechanism for relative tolerances. It is half the diagonal of the bounding box of
/// its joints, or their distance from the origin if they are at one point.
#[must_use]
pub fn mechanism_size(mechanism: &Mechanism) -> f64 {
    let points: Vec<Vector> = mechanism
        .joints
        .iter()
        .map(|j| to_vector(&j.frame.point))
        .collect();
    Extent::from_points(&points).length
}

/// A coordinate that rounding may have moved.
#[derive(Debug, Clone, Copy)]
pub(in crate::rank) struct Coordinate {
    pub(in crate::rank) joint: JointId,
    /// 0 for the point, 1 for the axis, 2 for the reference.
    pub(in crate::rank) vector: usize,
    pub(in crate::rank) component: usize,
    /// How far it may be off.
    pub(in crate::rank) half: f64,
    /// Size of what it belongs to: the mechanism, or the direction.
    pub(in crate::rank) scale: f64,
    pub(in crate::rank) written: f64,
}

/// Returns the coordinates of some joints that may be rounded.
pub(in crate::rank) fn rounded_coordinates(
    m: &Mechanism,
    joints: impl IntoIterator<Item = JointId>,
    half: &Uncertainties,
) -> Vec<Coordinate> {
    let size = mechanism_size(m);
    // In a plane, axes must stay perpendicular to it.
    let vectors = match m.mode {
        Mode::Spatial => 3,
        Mode::Planar { .. } => 1,
    };
    let mut out = Vec::new();
    for joint in joints {
        let (frame, half) = (&m.joints[joint].frame, &half.frames[joint.index()]);
        let all = frame.vectors().map(to_vector).into_iter();
        for (vector, (of, halves)) in all.zip(half.vectors()).enumerate().take(vectors) {
            let of_vector = of.into_iter().zip(halves).enumerate();
            let inexact = of_vector.filter(|(_, (_, half))| *half > 0.0);
            out.extend(inexact.map(|(component, (written, half))| Coordinate {
                joint,
                vector,
                component,
                half,
                scale: if vector == 0 { size } else { length(of) },
                written,
            }));
        }
    }
    out
}

/// Returns the values of a joint's frame with a coordinate changed.
pub(in crate::rank) fn frame_with(m: &Mechanism, c: &Coordinate, value: f64) -> FrameValues<f64> {
    let frame = &m.joints[c.joint].frame;
    let mut vectors = frame.vectors().map(to_vector);
    vectors[c.vector][c.component] = value;
    FrameValues::from_vectors(&Reals, vectors, frame.pitch.to_f64())
}
