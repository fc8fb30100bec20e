//! Statics of mechanisms: Assur groups and their kinetostatics, and joint reactions of any mechanism, planar or
//! spatial. This module uses geometry and motion, and is independent of files, searches and reports.
//!
//! [`solve::solve_reactions`] takes a mechanism to its reactions: in its plane ([`cycle`]) if that determines them, otherwise in
//! space ([`reactions`]).

pub mod assur;
pub mod assur_class;
pub(crate) mod cone_programme;
pub mod contour_group;
pub mod cycle;
pub mod kinetostatics;
pub mod planar;
pub mod pose;
pub mod reactions;
pub mod solve;
pub mod transmission;

use ozols_dense::{Matrix, singular_values};

/// Returns the size up to which figures of a solution are rounding errors. It is the residual of the equations, and at
/// least the rounding of a sum of `terms` numbers as large as the largest of them.
pub(crate) fn rounding_size(left_over: f64, greatest: f64, terms: usize) -> f64 {
    left_over.max(f64::EPSILON * terms as f64 * greatest)
}

/// Returns a figure, or 0 if it is a rounding error. If the rounding is not finite, no figure is.
pub(crate) fn drop_rounding(rounding: f64, figure: f64) -> f64 {
    if figure.abs() <= rounding && rounding.is_finite() {
        0.0
    } else {
        figure
    }
}

/// Returns the largest absolute figure.
pub(crate) fn greatest_abs<'x>(figures: impl IntoIterator<Item = &'x f64>) -> f64 {
    let sizes = figures.into_iter().map(|x| x.abs());
    sizes.fold(0.0, f64::max)
}

/// Returns the mean of some points, or the origin if there are none.
pub(crate) fn mean_point<const N: usize>(points: &[[f64; N]]) -> [f64; N] {
    #[allow(clippy::cast_precision_loss, reason = "at most a few thousand")]
    let count = points.len().max(1) as f64;
    std::array::from_fn(|i| points.iter().fold(0.0, |sum, p| sum + p[i]) / count)
}

/// Returns the residual of equations relative to the largest load, or unchanged without loads.
pub(crate) fn over_load(left_over: f64, load: f64) -> f64 {
    left_over / if load > 0.0 { load } else { 1.0 }
}

/// Returns the ratio of the largest to the smallest singular value; infinite for singular matrices.
pub(crate) fn condition_number(matrix: &Matrix) -> f64 {
    let Some(values) = singular_values(matrix) else {
        return f64::INFINITY;
    };
    match (values.first(), values.last()) {
        (Some(greatest), Some(smallest)) if *smallest > 0.0 => greatest / smallest,
        (None, None) => 1.0,
        _ => f64::INFINITY,
    }
}
