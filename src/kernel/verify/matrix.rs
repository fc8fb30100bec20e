//! The matrix of a certificate.

use num_bigint::BigInt;
use num_traits::One;

use crate::linalg::common_multiple;
use crate::linalg::number_ring::{Element, NumberRing};

/// A sparse matrix over a number ring.
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixOverRing {
    ring: NumberRing,
    cosine_order: Option<u64>,
    rows: usize,
    /// The nonzero entries of each column, as (row, number), rows ascending.
    columns: Vec<Vec<(usize, Element)>>,
}

impl MatrixOverRing {
    /// Creates a matrix from its entries `(row, column, number)`. Omitted entries are 0, and the last of repeated
    /// entries counts. With `cosine_order` N, the first generator of the ring represents 2 cos(2π/N). O(entries · log).
    ///
    /// Returns `None` if an entry lies outside the matrix or the ring.
    #[must_use]
    pub fn new(
        ring: NumberRing,
        cosine_order: Option<u64>,
        [rows, columns]: [usize; 2],
        entries: impl IntoIterator<Item = (usize, usize, Element)>,
    ) -> Option<MatrixOverRing> {
        let mut by_column = vec![std::collections::BTreeMap::new(); columns];
        for (row, column, number) in entries {
            if row >= rows || column >= columns || !ring.contains(&number) {
                return None;
            }
            if number.is_zero() {
                by_column[column].remove(&row);
            } else {
                by_column[column].insert(row, number);
            }
        }
        let columns = by_column.into_iter();
        let columns = columns.map(|c| c.into_iter().collect()).collect();
        Some(MatrixOverRing {
            ring,
            cosine_order,
            rows,
            columns,
        })
    }

    /// Returns the ring. O(1).
    #[must_use]
    pub fn ring(&self) -> &NumberRing {
        &self.ring
    }

    /// Returns N if the first generator represents 2 cos(2π/N). O(1).
    #[must_use]
    pub fn cosine_order(&self) -> Option<u64> {
        self.cosine_order
    }

    /// Returns the number of rows. O(1).
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of columns. O(1).
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns.len()
    }

    /// Returns the nonzero entries of a column, rows ascending. O(1).
    ///
    /// # Panics
    /// Panics if there is no such column.
    #[must_use]
    pub fn column(&self, column: usize) -> &[(usize, Element)] {
        &self.columns[column]
    }

    /// Returns the nonzero entries as (row, column, number), column by column. O(1) each.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &Element)> {
        let columns = self.columns.iter().enumerate();
        columns.flat_map(|(c, column)| column.iter().map(move |(r, x)| (*r, c, x)))
    }

    /// Returns the nonzero entries, column by column, each times the common denominator of its row. This is the matrix
    /// with each row multiplied, whose entries are integral combinations of the monomials. O(entries) greatest common
    /// divisors.
    #[must_use]
    pub(crate) fn integral_rows(&self) -> Vec<Vec<Vec<BigInt>>> {
        let mut below = vec![BigInt::one(); self.rows];
        for (row, _, x) in self.entries() {
            below[row] = common_multiple(std::mem::take(&mut below[row]), &x.denominator());
        }
        let integral = |(row, x): &(usize, Element)| x.integral_coordinates(&below[*row]);
        let columns = self.columns.iter();
        columns.map(|c| c.iter().map(integral).collect()).collect()
    }

    /// Returns a nonzero entry. O(log entries of the column).
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> Option<&Element> {
        let entries = self.columns.get(column)?;
        let at = entries.binary_search_by_key(&row, |(r, _)| *r).ok()?;
        Some(&entries[at].1)
    }
}
