//! Row echelon forms over a prime field, grown one vector at a time.

use crate::linalg::modp::{Field, Residue};

/// A span in row echelon form.
#[derive(Debug, Clone)]
pub struct Echelon {
    field: Field,
    rows: Vec<(usize, Vec<Residue>)>,
}

impl Echelon {
    /// Creates the zero span.
    #[must_use]
    pub fn new(field: Field) -> Self {
        Echelon {
            field,
            rows: Vec::new(),
        }
    }

    /// Creates the span of some vectors.
    #[must_use]
    pub fn from_vectors<V: AsRef<[Residue]>>(
        field: Field,
        vectors: impl IntoIterator<Item = V>,
    ) -> Self {
        let mut span = Echelon::new(field);
        for v in vectors {
            span.insert(v.as_ref());
        }
        span
    }

    /// Returns the dimension of the span.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Returns the indices of the pivots, ascending: coordinates that determine all others of a vector in the span.
    #[must_use]
    pub fn pivots(&self) -> Vec<usize> {
        self.rows.iter().map(|(pivot, _)| *pivot).collect()
    }

    /// Subtracts from `v` its part along the pivots.
    pub fn reduce_vector(&self, v: &mut [Residue]) {
        let f = self.field;
        for (pivot, row) in &self.rows {
            // Rows are zero before their pivot, which is scaled to one.
            f.subtract_multiple(&mut v[*pivot..], &row[*pivot..]);
        }
    }

    /// Adds a vector to the span. Returns true if it was independent. O(rank · length).
    pub fn insert(&mut self, v: &[Residue]) -> bool {
        let f = self.field;
        let mut v = v.to_vec();
        self.reduce_vector(&mut v);
        let Some(pivot) = v.iter().position(|&x| x != 0) else {
            return false;
        };
        if v[pivot] != f.one() {
            let scale = f.inv(v[pivot]);
            let others = v[pivot..].iter_mut().filter(|x| **x != 0);
            others.for_each(|x| *x = f.mul(*x, scale));
        }
        let at = self.rows.partition_point(|(p, _)| *p < pivot);
        self.rows.insert(at, (pivot, v));
        true
    }

    /// Returns true if a vector lies in the span.
    #[must_use]
    pub fn contains(&self, v: &[Residue]) -> bool {
        let mut v = v.to_vec();
        self.reduce_vector(&mut v);
        v.iter().all(|&x| x == 0)
    }

    /// Returns the reduced row echelon form: a canonical basis of the span, pivots ascending.
    #[must_use]
    pub fn reduced_rows(&self) -> Vec<Vec<Residue>> {
        let f = self.field;
        let mut out: Vec<(usize, Vec<Residue>)> = self.rows.clone();
        for i in (0..out.len()).rev() {
            let (pivot, row) = out[i].clone();
            for (_, above) in &mut out[..i] {
                f.subtract_multiple(&mut above[pivot..], &row[pivot..]);
            }
        }
        out.into_iter().map(|(_, v)| v).collect()
    }

    /// Returns a basis of the vectors of a length whose products with all vectors of the span are zero. Each ends in a
    /// one at which no other has an entry, and they are sorted by their ends.
    #[must_use]
    pub fn null_space(&self, length: usize) -> Vec<Vec<Residue>> {
        let (pivots, rows) = (self.pivots(), self.reduced_rows());
        let free = (0..length).filter(|c| pivots.binary_search(c).is_err());
        let vector = |free: usize| {
            let mut v = vec![0; length];
            v[free] = self.field.one();
            for (&pivot, row) in pivots.iter().zip(&rows) {
                v[pivot] = self.field.neg(row[free]);
            }
            v
        };
        free.map(vector).collect()
    }
}

/// Returns the dimension of the span of some vectors.
///
/// # Examples
/// ```
/// use ozols::linalg::{echelon::rank_of, modp::Field};
/// let f = Field::new(1_000_003);
/// let row = |all: [i64; 3]| all.map(|x| f.from_i64(x));
/// let rows = [row([1, 2, 3]), row([4, 5, 6]), row([7, 8, 9])];
/// assert_eq!(rank_of(f, rows.iter().map(|r| &r[..])), 2);
/// ```
#[must_use]
pub fn rank_of<'a>(field: Field, vectors: impl IntoIterator<Item = &'a [Residue]>) -> usize {
    Echelon::from_vectors(field, vectors).rank()
}

/// Returns a basis of the linear relations between some vectors of equal length. This is the kernel of the matrix with
/// these columns, in reduced row echelon form, so that each relation has its own vector, before all others in it.
///
/// # Complexity
/// O(width · rank · n) for n vectors, less for sparse ones.
#[must_use]
pub fn linear_relations(field: Field, vectors: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
    let width = vectors.first().map_or(0, Vec::len);
    let rows = (0..width).map(|i| vectors.iter().rev().map(|v| v[i]).collect::<Vec<_>>());
    let mut found = Echelon::from_vectors(field, rows).null_space(vectors.len());
    found.iter_mut().for_each(|v| v.reverse());
    found.reverse();
    found
}

/// Returns the linear combination of some vectors of equal length with the given factors. Empty if there are no
/// vectors.
#[must_use]
pub fn linear_combination(
    field: Field,
    vectors: &[Vec<Residue>],
    factors: &[Residue],
) -> Vec<Residue> {
    let mut out = vec![0; vectors.first().map_or(0, Vec::len)];
    for (v, &a) in vectors.iter().zip(factors).filter(|(_, a)| **a != 0) {
        field.add_multiple(&mut out, a, v);
    }
    out
}

/// Returns the transpose of a list of equally long vectors.
#[must_use]
pub fn transpose(vectors: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
    let width = vectors.first().map_or(0, Vec::len);
    (0..width)
        .map(|i| vectors.iter().map(|v| v[i]).collect())
        .collect()
}

/// The combinations of some vectors.
#[derive(Debug)]
pub(crate) struct Combinations {
    count: usize,
    /// Each vector is followed by its negative unit vector, so a sum that reduces to zero leaves its factors there.
    rows: Echelon,
}

impl Combinations {
    /// Prepares the combinations of some vectors.
    ///
    /// # Complexity
    /// O(n²·(w + n)) field operations for n vectors of w coordinates.
    pub(crate) fn new<V: AsRef<[Residue]>>(field: Field, vectors: &[V]) -> Combinations {
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
    pub(crate) fn factors_of(&self, sum: &[Residue]) -> Option<Vec<Residue>> {
        let mut row = sum.to_vec();
        row.resize(sum.len() + self.count, 0);
        self.rows.reduce_vector(&mut row);
        let factors = row.split_off(sum.len());
        row.iter().all(|&x| x == 0).then_some(factors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::modp::is_prime;
    use proptest::prelude::*;

    /// Reference implementation: eliminates vectors tagged with unit vectors densely, then reduces the kernel.
    fn by_tags(field: Field, vectors: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
        let width = vectors.first().map_or(0, Vec::len);
        let mut e = Echelon::new(field);
        for (i, v) in vectors.iter().enumerate() {
            let mut tagged = v.clone();
            tagged.resize(width + vectors.len(), 0);
            tagged[width + i] = field.one();
            e.insert(&tagged);
        }
        let mut kernel = Echelon::new(field);
        for row in e.reduced_rows() {
            if row[..width].iter().all(|&x| x == 0) {
                kernel.insert(&row[width..]);
            }
        }
        kernel.reduced_rows()
    }

    proptest! {
        #[test]
        fn relations_are_those_of_the_slow_twin(
            width in 0usize..9,
            entries in proptest::collection::vec(proptest::collection::vec(-2i64..3, 9), 0..12),
            mask in any::<u64>(),
        ) {
            let p = (1u64 << 61..).find(|&n| is_prime(n)).unwrap();
            let f = Field::new(p);
            let vectors: Vec<Vec<Residue>> = entries
                .iter()
                .enumerate()
                .map(|(i, row)| {
                    let kept = |c: usize| mask >> ((7 * i + c) % 64) & 1 == 1;
                    (0..width).map(|c| if kept(c) { f.from_i64(row[c]) } else { 0 }).collect()
                })
                .collect();
            prop_assert_eq!(linear_relations(f, &vectors), by_tags(f, &vectors));
        }
    }
}
