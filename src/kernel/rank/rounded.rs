//! Coordinates that are rounded: what was meant by them, and whether the digits decide the rank.

pub mod intended;
pub mod moves;
pub mod nearest_lower_rank;
pub mod nearly_special;
pub mod verdict;

use crate::geom::extent::Extent;
use crate::geom::vector::{Vector, real};
use crate::model::mechanism::Mechanism;

/// Returns the size of a mechanism that relative tolerances are of: half the diagonal of the box round its joints, or their distance
/// from the origin where they are one point.
#[must_use]
pub fn size(mechanism: &Mechanism) -> f64 {
    let points: Vec<Vector> = mechanism
        .joints
        .iter()
        .map(|j| real(&j.frame.point))
        .collect();
    Extent::of(&points).length
}
