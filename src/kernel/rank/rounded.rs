//! Rounded coordinates: the geometry they intend, and whether the digits determine the rank.

pub mod intended;
pub mod moves;
pub mod nearest_lower_rank;
pub mod nearly_special;
pub mod verdict;

use crate::geom::extent::Extent;
use crate::geom::vector::{Vector, real};
use crate::model::mechanism::Mechanism;

/// Returns the reference size of a mechanism for relative tolerances. It is half the diagonal of the bounding box of
/// its joints, or their distance from the origin if they are at one point.
#[must_use]
pub fn size(mechanism: &Mechanism) -> f64 {
    let points: Vec<Vector> = mechanism
        .joints
        .iter()
        .map(|j| real(&j.frame.point))
        .collect();
    Extent::of(&points).length
}
