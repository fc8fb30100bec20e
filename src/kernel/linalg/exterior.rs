//! Spaces by their minors: products of vectors in the exterior algebra.
//!
//! Two spaces whose dimensions add up to that of the whole span it where the product of both is not nothing, and that is one sum of
//! products of their coordinates: little where many spaces meet many others.
//!
//! # Sources
//! Grassmann, "Die Ausdehnungslehre" (1862); Plücker coordinates: Hodge & Pedoe, Methods of Algebraic Geometry I, chapter VII.

use crate::linalg::modp::{Field, Residue};

/// Products of vectors of so many numbers.
#[derive(Debug)]
pub(crate) struct Exterior {
    field: Field,
    width: usize,
    /// The sets of so many coordinates as bits, ascending.
    sets: Vec<Vec<usize>>,
    /// The place of each set among those of its size.
    places: Vec<usize>,
    /// Of each set of so many coordinates, for each of these from the last on: the place of the others, and it.
    faces: Vec<Vec<[usize; 2]>>,
}

impl Exterior {
    /// # Complexity
    /// O(2^n) for vectors of n numbers.
    pub(crate) fn new(field: Field, width: usize) -> Exterior {
        let mut sets = vec![Vec::new(); width + 1];
        let place = |set: usize| {
            let alike: &mut Vec<usize> = &mut sets[set.count_ones() as usize];
            alike.push(set);
            alike.len() - 1
        };
        let places: Vec<usize> = (0..1 << width).map(place).collect();
        let faces = |sets: &Vec<usize>| {
            let of = |&set: &usize| {
                let members = (0..width).rev().filter(move |i| set >> i & 1 == 1);
                members.map(move |i| [set & !(1 << i), i])
            };
            let faces = sets.iter().flat_map(of);
            faces.map(|[rest, i]| [places[rest], i]).collect()
        };
        Exterior {
            field,
            width,
            faces: sets.iter().map(faces).collect(),
            sets,
            places,
        }
    }

    /// The product of some vectors: all minors of theirs, by the set of their coordinates.
    ///
    /// # Complexity
    /// O(n·b) field operations for n vectors and b minors.
    pub(crate) fn product<'v>(
        &self,
        vectors: impl IntoIterator<Item = &'v [Residue]>,
    ) -> Vec<Residue> {
        let f = self.field;
        let mut product = vec![f.one()];
        for (size, vector) in vectors.into_iter().enumerate() {
            let term = |&[place, i]: &[usize; 2]| (product[place], vector[i]);
            let minor = |faces: &[[usize; 2]]| {
                let every_other = |from| faces[from..].iter().step_by(2).map(term);
                let [plus, minus] = [0, 1].map(|from| f.sum_of_products(every_other(from)));
                f.sub(plus, minus)
            };
            // More vectors than there are numbers are dependent.
            let faces = self.faces.get(size + 1);
            let faces = faces.map(|all| all.chunks_exact(size + 1));
            product = faces.map_or(Vec::new(), |all| all.map(minor).collect());
        }
        product
    }

    /// Whether the vectors of a product, and those of a [complement](Self::complement), are independent.
    pub(crate) fn whole(&self, product: &[Residue], complement: &[Residue]) -> bool {
        self.field.dot(product, complement) != 0
    }

    /// A product of so many vectors in such an order, and with such signs, that its sum of products with another of the others that a
    /// whole needs is the determinant of all.
    ///
    /// # Complexity
    /// O(n·b) for vectors of n numbers and b minors.
    pub(crate) fn complement(&self, product: &[Residue], vectors: usize) -> Vec<Residue> {
        let whole = (1 << self.width) - 1;
        let of = |&set: &usize| {
            let rest = whole & !set;
            // Each coordinate of the set goes past the smaller ones of the rest.
            let members = (0..self.width).filter(|i| set >> i & 1 == 1);
            let passed: u32 = members.map(|i| (rest & ((1 << i) - 1)).count_ones()).sum();
            let minor = product[self.places[rest]];
            if passed.is_multiple_of(2) {
                minor
            } else {
                self.field.neg(minor)
            }
        };
        self.sets[self.width - vectors].iter().map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Exterior;
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
            let [a, b] = [one, other].map(|of| exterior.product(of.iter().map(Vec::as_slice)));
            prop_assert_eq!(a.iter().all(|&x| x == 0), rows(one) < first);
            let determinant = f.dot(&a, &exterior.complement(&b, width - first));
            prop_assert_eq!(determinant == 0, rows(&all) < width);
            let at_once = exterior.product(all.iter().map(Vec::as_slice));
            prop_assert_eq!(at_once, vec![determinant]);
        }
    }
}
