//! Rank-revealing values of a decomposition in either format of floating-point numbers.

use crate::decompose::singular_values;
use crate::matrix::Matrix;
use faer::traits::{ComplexField, RealField};
use faer::{Mat, MatRef};

/// A floating-point format for elimination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// 32 bits.
    Single,
    /// 64 bits.
    Double,
}

impl Format {
    /// Returns the absolute diagonal of U of LU factors with full pivoting.
    #[must_use]
    pub fn lu_pivots(self, a: &Matrix) -> Vec<f64> {
        match self {
            _ if a.is_empty() => Vec::new(),
            Format::Single => absolute_diagonal(round_to_single(a).full_piv_lu().U()),
            Format::Double => absolute_diagonal(a.as_faer().full_piv_lu().U()),
        }
    }

    /// Returns the absolute diagonal of R of QR factors with column pivoting.
    #[must_use]
    pub fn qr_diagonal(self, a: &Matrix) -> Vec<f64> {
        match self {
            _ if a.is_empty() => Vec::new(),
            Format::Single => absolute_diagonal(round_to_single(a).col_piv_qr().R()),
            Format::Double => absolute_diagonal(a.as_faer().col_piv_qr().R()),
        }
    }

    /// Returns the singular values, the largest first. Returns `None` if the iteration does not converge or a value is
    /// not finite.
    #[must_use]
    pub fn singular_values(self, a: &Matrix) -> Option<Vec<f64>> {
        if a.is_empty() || self == Format::Double {
            return singular_values(a);
        }
        let values = round_to_single(a).singular_values().ok()?;
        let finite = values.iter().all(|v| v.is_finite());
        finite.then(|| values.into_iter().map(f64::from).collect())
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "single precision is the point"
)]
fn round_to_single(a: &Matrix) -> Mat<f32> {
    Mat::from_fn(a.nrows(), a.ncols(), |r, c| a[(r, c)] as f32)
}

fn absolute_diagonal<T: ComplexField<Real = T> + RealField + Copy + Into<f64>>(
    factor: MatRef<'_, T>,
) -> Vec<f64> {
    (0..factor.nrows().min(factor.ncols()))
        .map(|i| factor[(i, i)].into().abs())
        .collect()
}
