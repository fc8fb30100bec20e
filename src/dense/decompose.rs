//! Decompositions of a matrix, and the problems they solve.

use crate::matrix::Matrix;
use faer::linalg::solvers::{Solve, SolveLstsq};
use faer::traits::{ComplexField, RealField};
use faer::{Mat, MatRef, Side};

/// Singular values and vectors: A = U · diag(values) · Vᵀ.
#[derive(Debug, Clone)]
pub struct Svd {
    /// The singular values, the largest first: as many as the smaller of A's numbers of rows and columns.
    pub values: Vec<f64>,
    /// Left singular vectors, by columns.
    pub u: Matrix,
    /// Right singular vectors, by columns.
    pub v: Matrix,
}

impl Svd {
    /// Returns the number of singular values above this fraction of the largest.
    #[must_use]
    pub fn rank(&self, tolerance: f64) -> usize {
        let least = tolerance * self.values.first().copied().unwrap_or(0.0);
        self.values.iter().filter(|&&s| s > least).count()
    }

    /// Returns the null space of A, treated as a matrix of this rank: orthonormal columns.
    ///
    /// # Panics
    /// Panics if the rank exceeds the number of columns of A.
    #[must_use]
    pub fn null_space(&self, rank: usize) -> Matrix {
        self.v.cols(rank..self.v.ncols())
    }

    /// Returns the left null space of A, treated as a matrix of this rank: orthonormal columns.
    ///
    /// # Panics
    /// Panics if the rank exceeds the number of rows of A.
    #[must_use]
    pub fn left_null_space(&self, rank: usize) -> Matrix {
        self.u.cols(rank..self.u.ncols())
    }

    /// Returns the shortest x for each right side that minimises the distance of A·x from it, with A treated as a
    /// matrix of this rank.
    ///
    /// # Panics
    /// Panics if the right sides do not have as many rows as A.
    #[must_use]
    pub fn least_norm(&self, rank: usize, right: &Matrix) -> Matrix {
        let along = self.u.cols(0..rank).transpose_times(right);
        let along = Matrix::from_fn(rank, right.ncols(), |i, c| along[(i, c)] / self.values[i]);
        self.v.cols(0..rank).times(&along)
    }
}

/// Returns all singular values and vectors, with U and V square. Returns `None` if the iteration does not converge or a
/// value is not finite.
#[must_use]
pub fn svd(a: &Matrix) -> Option<Svd> {
    if a.is_empty() {
        return Some(Svd {
            values: Vec::new(),
            u: Matrix::identity(a.nrows(), a.nrows()),
            v: Matrix::identity(a.ncols(), a.ncols()),
        });
    }
    let found = a.as_faer().svd().ok()?;
    collect_factors(&found)
}

/// Works as [`svd`], with as many columns in U and V as there are values.
#[must_use]
pub fn thin_svd(a: &Matrix) -> Option<Svd> {
    if a.is_empty() {
        return Some(Svd {
            values: Vec::new(),
            u: Matrix::zeros(a.nrows(), 0),
            v: Matrix::zeros(a.ncols(), 0),
        });
    }
    let found = a.as_faer().thin_svd().ok()?;
    collect_factors(&found)
}

fn collect_factors(found: &faer::linalg::solvers::Svd<f64>) -> Option<Svd> {
    let values: Vec<f64> = found.S().column_vector().iter().copied().collect();
    let finite = values.iter().all(|v| v.is_finite());
    finite.then(|| Svd {
        values,
        u: Matrix::from_faer(found.U()),
        v: Matrix::from_faer(found.V()),
    })
}

/// Returns the singular values, the largest first. Returns `None` if the iteration does not converge or a value is not
/// finite.
#[must_use]
pub fn singular_values(a: &Matrix) -> Option<Vec<f64>> {
    if a.is_empty() {
        return Some(Vec::new());
    }
    let values = a.as_faer().singular_values().ok()?;
    values.iter().all(|v| v.is_finite()).then_some(values)
}

/// Returns the eigenvalues of a symmetric matrix, the smallest first, and its eigenvectors by columns. Returns `None`
/// if the iteration does not converge.
#[must_use]
pub fn symmetric_eigen(a: &Matrix) -> Option<(Vec<f64>, Matrix)> {
    let found = a.as_faer().self_adjoint_eigen(Side::Lower).ok()?;
    let values = found.S().column_vector().iter().copied().collect();
    Some((values, Matrix::from_faer(found.U())))
}

/// Returns the x that minimises the distance of A·x from the right side, by QR factors. A must have at least as many
/// rows as columns, and full rank.
#[must_use]
pub fn least_squares(a: &Matrix, right: &[f64]) -> Vec<f64> {
    let x = a
        .as_faer()
        .qr()
        .solve_lstsq(Matrix::from_column(right).as_faer());
    first_column(&x, a.ncols())
}

/// Works as [`least_squares`], with column pivoting for accuracy.
#[must_use]
pub fn least_squares_pivoted(a: &Matrix, right: &[f64]) -> Vec<f64> {
    let factors = a.as_faer().col_piv_qr();
    first_column(
        &factors.solve_lstsq(Matrix::from_column(right).as_faer()),
        a.ncols(),
    )
}

/// Returns the solution of a square system, by LU factors with partial pivoting. It is not finite if there is none.
#[must_use]
pub fn solve(a: &Matrix, right: &[f64]) -> Vec<f64> {
    let factors = a.as_faer().partial_piv_lu();
    first_column(
        &factors.solve(Matrix::from_column(right).as_faer()),
        a.ncols(),
    )
}

/// Returns the solution of a symmetric positive definite system, by Cholesky factors, or `None` if the matrix is not
/// positive definite.
#[must_use]
pub fn solve_positive(a: &Matrix, right: &[f64]) -> Option<Vec<f64>> {
    let factors = a.as_faer().llt(Side::Lower).ok()?;
    Some(first_column(
        &factors.solve(Matrix::from_column(right).as_faer()),
        a.ncols(),
    ))
}

fn first_column(x: &Mat<f64>, rows: usize) -> Vec<f64> {
    (0..rows).map(|r| x[(r, 0)]).collect()
}

/// Returns the determinant of a square matrix.
#[must_use]
pub fn determinant(a: &Matrix) -> f64 {
    if a.nrows() == 0 {
        1.0
    } else {
        a.as_faer().determinant()
    }
}

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
