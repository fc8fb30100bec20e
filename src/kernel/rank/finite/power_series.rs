//! Truncated power series of several variables over a prime field, and their ideals.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use std::collections::BTreeMap;

/// The monomials of some variables by degree, and products of truncated series of them.
#[derive(Debug)]
pub(in crate::rank) struct Monomials {
    variables: usize,
    /// Exponents, one byte per variable, sorted by degree.
    keys: Vec<u128>,
    index: BTreeMap<u128, usize>,
    /// Start of each degree, and the end.
    starts: Vec<usize>,
    /// For each pair whose product is kept, the index of the product: `products[i][j]`.
    products: Vec<Vec<usize>>,
}

impl Monomials {
    /// Creates the monomials of degrees 0 and 1 in at most 16 variables.
    pub(in crate::rank) fn new(variables: usize) -> Monomials {
        let mut out = Monomials {
            variables,
            keys: vec![0],
            index: BTreeMap::from([(0, 0)]),
            starts: vec![0, 1],
            products: Vec::new(),
        };
        out.extend(1);
        out
    }

    /// Adds the next degree.
    pub(in crate::rank) fn extend(&mut self, degree: usize) {
        let before = self.of_degree(degree - 1);
        for i in before {
            // Each monomial arises once, by a variable no earlier than its last one.
            let key = self.keys[i];
            let last = (0..self.variables)
                .rev()
                .find(|v| key >> (8 * v) & 0xff != 0)
                .unwrap_or(0);
            for v in last..self.variables {
                let next = key + (1 << (8 * v));
                self.index.insert(next, self.keys.len());
                self.keys.push(next);
            }
        }
        self.starts.push(self.keys.len());
        self.products = (0..=degree)
            .flat_map(|d| self.of_degree(d).map(move |i| (d, i)))
            .map(|(d, i)| {
                (0..self.starts[degree - d + 1])
                    .map(|j| self.index[&(self.keys[i] + self.keys[j])])
                    .collect()
            })
            .collect();
    }

    fn degree(&self) -> usize {
        self.starts.len() - 2
    }

    fn count_monomials(&self) -> usize {
        self.keys.len()
    }

    pub(in crate::rank) fn count_pairs(&self) -> usize {
        self.products.iter().map(Vec::len).sum()
    }

    pub(in crate::rank) fn of_degree(&self, degree: usize) -> std::ops::Range<usize> {
        self.starts[degree]..self.starts[degree + 1]
    }

    /// Returns the value of a monomial at a point.
    pub(in crate::rank) fn value(&self, f: Field, monomial: usize, at: &[Residue]) -> Residue {
        let key = self.keys[monomial];
        let powers = at.iter().enumerate();
        let powers = powers.map(|(v, &x)| f.pow(x, (key >> (8 * v) & 0xff) as u64));
        powers.fold(f.one(), |product, x| f.mul(product, x))
    }

    /// Returns whether all monomials of the highest degree lie in the ideal of some series, up to higher degrees.
    /// Returns `None` if that takes more than `work` products.
    pub(in crate::rank) fn all_in_ideal(
        &self,
        f: Field,
        series: &[Vec<Residue>],
        work: usize,
    ) -> Option<bool> {
        let degree = self.degree();
        let nonzero = series.iter().filter(|s| s.iter().any(|&x| x != 0));
        let rows = Echelon::from_vectors(f, nonzero).reduced_rows();
        let shifts = |row: &[Residue]| {
            let order = row.iter().position(|&x| x != 0).unwrap_or(0);
            let own = (0..=degree)
                .find(|&d| self.of_degree(d).contains(&order))
                .unwrap_or(degree);
            self.starts[degree - own + 1]
        };
        let total: usize = rows.iter().map(|r| shifts(r)).sum();
        if total * self.count_monomials().pow(2) > work {
            return None;
        }
        let top = self.of_degree(degree);
        if total < top.len() {
            return Some(false);
        }
        let mut span = Echelon::new(f);
        for row in &rows {
            for i in 0..shifts(row) {
                let mut shifted = vec![0; self.count_monomials()];
                for (&x, &at) in row.iter().zip(&self.products[i]) {
                    shifted[at] = x;
                }
                span.insert(&shifted);
            }
        }
        let inside = span
            .reduced_rows()
            .iter()
            .filter(|r| {
                r.iter()
                    .position(|&x| x != 0)
                    .is_some_and(|p| top.contains(&p))
            })
            .count();
        Some(inside == top.len())
    }
}
