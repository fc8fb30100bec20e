//! Row echelon forms over a prime field, grown one vector at a time.

use crate::linalg::modp::{Field, Residue};

/// A span in row echelon form.
#[derive(Debug, Clone)]
pub struct Echelon {
    field: Field,
    rows: Vec<(usize, Vec<Residue>)>,
}

impl Echelon {
    /// The zero span.
    #[must_use]
    pub fn new(field: Field) -> Self {
        Echelon {
            field,
            rows: Vec::new(),
        }
    }

    /// Dimension of the span.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Subtracts from `v` its part along the pivots.
    pub fn reduce(&self, v: &mut [Residue]) {
        let f = self.field;
        for (pivot, row) in &self.rows {
            // Rows are zero before their pivot, and normed to one there.
            f.subtract_multiple(&mut v[*pivot..], &row[*pivot..]);
        }
    }

    /// Adds a vector to the span; true where it was independent. O(rank · length).
    pub fn insert(&mut self, v: &[Residue]) -> bool {
        let f = self.field;
        let mut v = v.to_vec();
        self.reduce(&mut v);
        let Some(pivot) = v.iter().position(|&x| x != 0) else {
            return false;
        };
        let scale = f.inv(v[pivot]);
        v[pivot..].iter_mut().for_each(|x| *x = f.mul(*x, scale));
        let at = self.rows.partition_point(|(p, _)| *p < pivot);
        self.rows.insert(at, (pivot, v));
        true
    }

    /// Whether a vector lies in the span.
    #[must_use]
    pub fn contains(&self, v: &[Residue]) -> bool {
        let mut v = v.to_vec();
        self.reduce(&mut v);
        v.iter().all(|&x| x == 0)
    }

    /// The reduced row echelon form: a canonical basis of the span, pivots ascending.
    #[must_use]
    pub fn reduced(&self) -> Vec<Vec<Residue>> {
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
}

/// Dimension of the span of some vectors.
#[must_use]
pub fn rank<'a>(field: Field, vectors: impl IntoIterator<Item = &'a [Residue]>) -> usize {
    let mut e = Echelon::new(field);
    for v in vectors {
        e.insert(v);
    }
    e.rank()
}

/// A basis of the linear relations among some vectors of equal length: the kernel of the matrix that has them as its
/// columns, in reduced row echelon form, so that each relation has a vector of its own.
#[must_use]
pub fn relations(field: Field, vectors: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
    let Some(width) = vectors.first().map(Vec::len) else {
        return Vec::new();
    };
    let mut e = Echelon::new(field);
    for (i, v) in vectors.iter().enumerate() {
        let mut tagged = v.clone();
        tagged.resize(width + vectors.len(), 0);
        tagged[width + i] = field.one();
        e.insert(&tagged);
    }
    let mut kernel = Echelon::new(field);
    for row in e
        .reduced()
        .into_iter()
        .filter(|r| r[..width].iter().all(|&x| x == 0))
    {
        kernel.insert(&row[width..]);
    }
    kernel.reduced()
}

/// The transpose of a list of equally long vectors.
#[must_use]
pub fn transpose(vectors: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
    let width = vectors.first().map_or(0, Vec::len);
    (0..width)
        .map(|i| vectors.iter().map(|v| v[i]).collect())
        .collect()
}
