//! Second-order test: whether an instantaneous motion can begin at all.
//!
//! A motion with speeds x, J x = 0, has accelerations a only where J a = -½ Σ [ξ_i x_i, ξ_j x_j] over pairs i before j
//! round each contour, that is where every self-stress does no work on the right side. With one instantaneous motion
//! and one self-stress that does work, nothing moves: a shaky pose, finite mobility 0 [Connelly & Whiteley 1996].

use super::subgroup::{bracket, spatial_twists};
use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{Mechanism, Mode};

/// Whether the speeds `x`, one a column of J, are stopped by second order. Spatial mode only; `false` in planar mode.
///
/// # Errors
/// Where a coordinate has no value in the field.
///
/// # Complexity
/// O(f² + rank of J with one more column).
pub fn stops(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    x: &[Residue],
) -> Result<bool, ExactError> {
    if matches!(mechanism.mode, Mode::Planar { .. }) {
        return Ok(false);
    }
    let field = exact.field();
    let mut right = Vec::with_capacity(closure.rows());
    for contour in &closure.contours {
        // Σ_{i<j} [x_i ξ_i, x_j ξ_j] = Σ_j [sum so far, x_j ξ_j]
        let (mut so_far, mut sum) = (vec![0; 6], vec![0; 6]);
        for &(j, forward) in &contour.joints {
            let columns: Vec<usize> = (0..closure.columns.len())
                .filter(|&c| closure.columns[c].joint == j)
                .collect();
            let twists = spatial_twists(exact, mechanism, j)?;
            // Translations before rotations, as in `closure::pose`; the reverse when passed backwards.
            let mut order: Vec<usize> = (0..columns.len()).collect();
            order.sort_by_key(|&i| twists[i][..3].iter().any(|&w| w != 0));
            if !forward {
                order.reverse();
            }
            for i in order {
                let speed = if forward {
                    x[columns[i]]
                } else {
                    field.neg(x[columns[i]])
                };
                let step: Vec<Residue> = twists[i].iter().map(|&t| field.mul(t, speed)).collect();
                let b = bracket(exact, &so_far, &step);
                for k in 0..6 {
                    sum[k] = field.add(sum[k], b[k]);
                    so_far[k] = field.add(so_far[k], step[k]);
                }
            }
        }
        right.extend(sum);
    }
    // Couplings are linear in the coordinates: they have no second order.
    right.resize(closure.rows(), 0);
    let mut columns = closure.dense(exact);
    let before = echelon::rank(field, columns.iter().map(Vec::as_slice));
    columns.push(right);
    Ok(echelon::rank(field, columns.iter().map(Vec::as_slice)) > before)
}
