//! Small dense systems of linear equations in double precision.

use ozols_dense::{Matrix, determinant, singular_values, solve};

/// A square system, by rows.
#[derive(Debug, Clone)]
pub(crate) struct System {
    matrix: Matrix,
}

impl System {
    /// Takes the rows of a square matrix.
    pub(crate) fn new(rows: &[Vec<f64>]) -> System {
        System {
            matrix: Matrix::from_fn(rows.len(), rows.len(), |r, c| rows[r][c]),
        }
    }

    /// The solution by LU with partial pivoting; `None` where it is not finite.
    pub(crate) fn solve(&self, right: &[f64]) -> Option<Vec<f64>> {
        let x = solve(&self.matrix, right);
        x.iter().all(|v| v.is_finite()).then_some(x)
    }

    /// Greatest absolute value of matrix·x - right.
    pub(crate) fn residual(&self, x: &[f64], right: &[f64]) -> f64 {
        let row = |r: usize| -> f64 {
            let sum: f64 = x
                .iter()
                .enumerate()
                .map(|(c, v)| self.matrix[(r, c)] * v)
                .sum();
            (sum - right[r]).abs()
        };
        (0..right.len()).map(row).fold(0.0, f64::max)
    }

    /// Whether the determinant is positive.
    pub(crate) fn is_positive(&self) -> bool {
        determinant(&self.matrix) > 0.0
    }

    /// Ratio of the greatest and smallest singular values; infinite for singular matrices.
    pub(crate) fn condition(&self) -> f64 {
        if self.matrix.nrows() == 0 {
            return 1.0;
        }
        let Some(values) = singular_values(&self.matrix) else {
            return f64::INFINITY;
        };
        let greatest = values.iter().copied().fold(0.0, f64::max);
        let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
        if smallest > 0.0 {
            greatest / smallest
        } else {
            f64::INFINITY
        }
    }
}
