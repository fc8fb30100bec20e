//! A matrix of doubles, stored by columns.

use faer::MatRef;
use std::ops::{Index, IndexMut, Range};

/// A matrix of doubles.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    /// The entries, column after column.
    entries: Vec<f64>,
}

impl Matrix {
    /// Creates the matrix with the entries `at(row, column)`.
    pub fn from_fn(rows: usize, columns: usize, mut at: impl FnMut(usize, usize) -> f64) -> Self {
        let mut entries = Vec::with_capacity(rows * columns);
        for c in 0..columns {
            entries.extend((0..rows).map(|r| at(r, c)));
        }
        Matrix {
            rows,
            columns,
            entries,
        }
    }

    /// Creates a matrix of zeros.
    #[must_use]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Matrix {
            rows,
            columns,
            entries: vec![0.0; rows * columns],
        }
    }

    /// Creates a matrix with ones on the diagonal and zeros elsewhere.
    #[must_use]
    pub fn identity(rows: usize, columns: usize) -> Self {
        Matrix::from_fn(rows, columns, |r, c| if r == c { 1.0 } else { 0.0 })
    }

    /// Creates a matrix with a single column.
    #[must_use]
    pub fn from_column(entries: &[f64]) -> Self {
        Matrix {
            rows: entries.len(),
            columns: 1,
            entries: entries.to_vec(),
        }
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn nrows(&self) -> usize {
        self.rows
    }

    /// Returns the number of columns.
    #[must_use]
    pub fn ncols(&self) -> usize {
        self.columns
    }

    /// Returns true if there are no entries.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Returns a column, from its first row on.
    ///
    /// # Panics
    /// Panics if there is no such column.
    #[must_use]
    pub fn col(&self, column: usize) -> &[f64] {
        &self.entries[column * self.rows..(column + 1) * self.rows]
    }

    /// Returns a mutable column.
    ///
    /// # Panics
    /// Panics if there is no such column.
    pub fn col_mut(&mut self, column: usize) -> &mut [f64] {
        &mut self.entries[column * self.rows..(column + 1) * self.rows]
    }

    /// Returns some columns.
    ///
    /// # Panics
    /// Panics if there are fewer columns.
    #[must_use]
    pub fn cols(&self, range: Range<usize>) -> Matrix {
        Matrix {
            rows: self.rows,
            columns: range.len(),
            entries: self.entries[range.start * self.rows..range.end * self.rows].to_vec(),
        }
    }

    /// Returns the product with another matrix.
    ///
    /// # Panics
    /// Panics if `other` does not have as many rows as this has columns.
    #[must_use]
    pub fn times(&self, other: &Matrix) -> Matrix {
        Matrix::from_faer((self.as_faer() * other.as_faer()).as_ref())
    }

    /// Returns the product of the transpose with another matrix.
    ///
    /// # Panics
    /// Panics if the two have different numbers of rows.
    #[must_use]
    pub fn transpose_times(&self, other: &Matrix) -> Matrix {
        Matrix::from_faer((self.as_faer().transpose() * other.as_faer()).as_ref())
    }

    /// Returns the sum of the columns times these weights.
    ///
    /// # Panics
    /// Panics if there are more weights than columns.
    #[must_use]
    pub fn combine_columns(&self, weights: &[f64]) -> Vec<f64> {
        let entry = |r: usize| {
            weights
                .iter()
                .enumerate()
                .map(|(c, w)| self[(r, c)] * w)
                .sum()
        };
        (0..self.rows).map(entry).collect()
    }

    /// Returns a row.
    #[must_use]
    pub fn row(&self, row: usize) -> Vec<f64> {
        (0..self.columns).map(|c| self[(row, c)]).collect()
    }

    /// Returns some rows.
    #[must_use]
    pub fn select_rows(&self, rows: &[usize]) -> Matrix {
        Matrix::from_fn(rows.len(), self.columns, |r, c| self[(rows[r], c)])
    }

    /// Returns some columns.
    #[must_use]
    pub fn select_columns(&self, columns: &[usize]) -> Matrix {
        Matrix::from_fn(self.rows, columns.len(), |r, c| self[(r, columns[c])])
    }

    /// Returns the length of all entries as one list, the Frobenius norm.
    #[must_use]
    pub fn norm(&self) -> f64 {
        norm(&self.entries)
    }

    /// Adds a multiple of another matrix of the same shape.
    ///
    /// # Panics
    /// Panics if the shapes differ.
    pub fn add_multiple(&mut self, factor: f64, other: &Matrix) {
        assert_eq!((self.rows, self.columns), (other.rows, other.columns));
        for (x, y) in self.entries.iter_mut().zip(&other.entries) {
            *x += factor * y;
        }
    }

    pub(crate) fn as_faer(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.entries, self.rows, self.columns)
    }

    pub(crate) fn from_faer(matrix: MatRef<'_, f64>) -> Matrix {
        Matrix::from_fn(matrix.nrows(), matrix.ncols(), |r, c| matrix[(r, c)])
    }
}

/// Returns the scalar product of two lists.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the length of a list as a vector.
#[must_use]
pub fn norm(a: &[f64]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Returns the largest absolute entry, or 0 if there are none.
#[must_use]
pub fn largest_entry(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// Returns `a + s·b` of two lists.
#[must_use]
pub fn add_scaled(a: &[f64], s: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + s * b).collect()
}

/// Returns `a - b` of two lists.
#[must_use]
pub fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        debug_assert!(row < self.rows);
        &self.entries[column * self.rows + row]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        debug_assert!(row < self.rows);
        &mut self.entries[column * self.rows + row]
    }
}
