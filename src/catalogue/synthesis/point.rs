//! Points of the plane in double precision.

use crate::geom::vector::add_scaled;

/// A point of the plane, in millimetres.
pub type Point = [f64; 2];

/// The middle of points.
#[must_use]
pub(crate) fn middle<const N: usize>(points: &[[f64; N]]) -> [f64; N] {
    #[allow(clippy::cast_precision_loss, reason = "a few")]
    let n = points.len().max(1) as f64;
    points
        .iter()
        .fold([0.0; N], |m, p| add_scaled(m, 1.0 / n, *p))
}
