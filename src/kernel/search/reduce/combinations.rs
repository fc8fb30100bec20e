//! Vectors as combinations of given ones.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};

/// The combinations of some vectors.
#[derive(Debug)]
pub(in crate::search) struct Combinations {
    count: usize,
    /// Behind each vector its unit, negative: what reduces to nothing carries its factors there.
    rows: Echelon,
}

impl Combinations {
    /// Prepares the combinations of some vectors.
    ///
    /// # Complexity
    /// O(n²·w) field operations for n vectors of w coordinates.
    pub(in crate::search) fn new<V: AsRef<[Residue]>>(field: Field, vectors: &[V]) -> Combinations {
        let count = vectors.len();
        let mut rows = Echelon::new(field);
        for (i, v) in vectors.iter().map(AsRef::as_ref).enumerate() {
            let mut row = v.to_vec();
            row.resize(v.len() + count, 0);
            row[v.len() + i] = field.neg(field.one());
            rows.reduce_vector(&mut row);
            if row[..v.len()].iter().any(|&x| x != 0) {
                rows.insert(&row);
            }
        }
        Combinations { count, rows }
    }

    /// Returns the factors with which the vectors add up to another, 0 for a vector that depends on those before it; `None` if there are
    /// none.
    pub(in crate::search) fn factors_of(&self, sum: &[Residue]) -> Option<Vec<Residue>> {
        let mut row = sum.to_vec();
        row.resize(sum.len() + self.count, 0);
        self.rows.reduce_vector(&mut row);
        let factors = row.split_off(sum.len());
        row.iter().all(|&x| x == 0).then_some(factors)
    }
}
