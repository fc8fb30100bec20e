//! Spaces represented by their minors: products of vectors in the exterior algebra.
//!
//! Two spaces whose dimensions add up to that of the whole space span it if and only if the product of both is nonzero.
//! This is one sum of products of their coordinates, which is cheap if many spaces meet many others.
//!
//! # Sources
//! Grassmann, "Die Ausdehnungslehre" (1862); Plücker coordinates: Hodge & Pedoe, Methods of Algebraic Geometry I,
//! chapter VII.

use crate::linalg::modp::{Field, Residue};

/// Products of vectors of a fixed length.
#[derive(Debug)]
pub(crate) struct Exterior {
    field: Field,
    width: usize,
    /// For each set of a given number of coordinates, and each member from the last on: the index of the other members,
    /// and the member.
    faces: Vec<Vec<[usize; 2]>>,
    /// For each set of a given number of coordinates: the index of its complement, and whether the sign changes if the
    /// complement comes first.
    others: Vec<Vec<(usize, bool)>>,
}

/// A product of some vectors: all their minors by sets of coordinates, in memory that the next product reuses.
#[derive(Debug, Default)]
pub(crate) struct Product {
    minors: Vec<Residue>,
    /// The minors of one vector fewer.
    before: Vec<Residue>,
    /// The entries of a vector, with their negatives.
    signed: Vec<[Residue; 2]>,
}

impl Product {
    /// Returns the minors.
    pub(crate) fn minors(&self) -> &[Residue] {
        &self.minors
    }
}

impl Exterior {
    /// Creates the tables for vectors of `width` numbers.
    ///
    /// # Complexity
    /// O(n·2^n) for vectors of n numbers.
    pub(crate) fn new(field: Field, width: usize) -> Exterior {
        // The sets of each size as bits, ascending, and the index of each among those of its size.
        let mut sets = vec![Vec::new(); width + 1];
        let place = |set: usize| {
            let alike: &mut Vec<usize> = &mut sets[set.count_ones() as usize];
            alike.push(set);
            alike.len() - 1
        };
        let places: Vec<usize> = (0..1 << width).map(place).collect();
        let members = |set: usize| (0..width).rev().filter(move |i| set >> i & 1 == 1);
        let faces = |sets: &Vec<usize>| {
            let of = |&set: &usize| members(set).map(move |i| [set & !(1 << i), i]);
            let faces = sets.iter().flat_map(of);
            faces.map(|[rest, i]| [places[rest], i]).collect()
        };
        let others = |&set: &usize| {
            let rest = ((1 << width) - 1) & !set;
            // Each coordinate of the set passes the smaller ones of the rest.
            let passed = members(set).map(|i| (rest & ((1 << i) - 1)).count_ones());
            (places[rest], !passed.sum::<u32>().is_multiple_of(2))
        };
        Exterior {
            field,
            width,
            faces: sets.iter().map(faces).collect(),
            others: sets
                .iter()
                .map(|sets| sets.iter().map(others).collect())
                .collect(),
        }
    }

    /// Computes the product of some vectors. It is zero if there are more vectors than entries of each.
    ///
    /// # Complexity
    /// O(n·b) field operations for n vectors and b minors.
    pub(crate) fn product<'v>(
        &self,
        vectors: impl IntoIterator<Item = &'v [Residue]>,
        product: &mut Product,
    ) {
        let f = self.field;
        let Product {
            minors,
            before,
            signed,
        } = product;
        minors.clear();
        minors.push(f.one());
        for (size, vector) in vectors.into_iter().enumerate() {
            std::mem::swap(minors, before);
            minors.clear();
            signed.clear();
            signed.extend(vector[..self.width].iter().map(|&x| [x, f.neg(x)]));
            let minor = |faces: &[[usize; 2]]| {
                let faces = faces.iter().enumerate();
                f.sum_of_products(faces.map(|(j, &[place, i])| (before[place], signed[i][j & 1])))
            };
            let faces = self.faces.get(size + 1);
            let faces = faces.map(|all| all.chunks_exact(size + 1));
            minors.extend(faces.into_iter().flatten().map(minor));
        }
    }

    /// Returns true if the vectors of a product, and those of a [complement](Self::complement), are independent.
    pub(crate) fn whole(&self, product: &[Residue], complement: &[Residue]) -> bool {
        self.field.dot(product, complement) != 0
    }

    /// Returns the minors of `vectors` vectors, ordered and signed so that their sum of products with the minors of the
    /// remaining vectors is the determinant of all.
    pub(crate) fn complement(
        &self,
        product: &Product,
        vectors: usize,
    ) -> impl Iterator<Item = Residue> {
        let others = &self.others[self.width - vectors];
        others.iter().map(|&(place, changes)| {
            let minor = product.minors[place];
            if changes {
                self.field.neg(minor)
            } else {
                minor
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Exterior, Product};
    use crate::linalg::echelon::rank;
    use crate::linalg::modp::{Field, Residue};
    use proptest::prelude::*;

    proptest! {
        /// Vectors of small numbers, so that many are dependent.
        #[test]
        fn products_are_nothing_where_an_elimination_has_a_smaller_rank(
            width in 0usize..7,
            first in 0usize..8,
            numbers in prop::collection::vec(-1i64..2, 49),
        ) {
            let f = Field::new((1 << 61) - 1);
            let first = first.min(width);
            let all: Vec<Vec<Residue>> = (0..width)
                .map(|i| numbers[i * 7..i * 7 + width].iter().map(|&x| f.from_i64(x)).collect())
                .collect();
            let rows = |of: &[Vec<Residue>]| rank(f, of.iter().map(Vec::as_slice));
            let exterior = Exterior::new(f, width);
            let [one, other] = [&all[..first], &all[first..]];
            // In memory used by another product before.
            let mut of = Product::default();
            let mut product = |vectors: &[Vec<Residue>]| {
                exterior.product(vectors.iter().map(Vec::as_slice), &mut of);
                of.minors().to_vec()
            };
            let [a, at_once] = [one, &all].map(&mut product);
            prop_assert_eq!(a.iter().all(|&x| x == 0), rows(one) < first);
            product(other);
            let complement: Vec<Residue> = exterior.complement(&of, width - first).collect();
            let determinant = f.dot(&a, &complement);
            prop_assert_eq!(determinant == 0, rows(&all) < width);
            prop_assert_eq!(exterior.whole(&a, &complement), determinant != 0);
            prop_assert_eq!(at_once, vec![determinant]);
        }
    }
}
