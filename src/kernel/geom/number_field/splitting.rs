//! Primes that split a number field, and primes that show that it is one.

use super::NumberField;
use crate::geom::exact::plan::{cosine_images, fields_from};
use crate::linalg::modp::{Field, Residue};

/// A field with the images of its generators in a prime field, under every homomorphism.
#[derive(Debug, Clone)]
pub(crate) struct Splitting {
    /// The prime field.
    pub field: Field,
    /// As many homomorphisms as the degree, each as the images of the generators.
    pub homomorphisms: Vec<Vec<Residue>>,
}

impl NumberField {
    /// Returns primes near 2^61 that split the field, with all homomorphisms. Each costs a search of 2^k primes, for k
    /// radicands whose roots reciprocity does not provide.
    pub(crate) fn splittings(&self) -> impl Iterator<Item = Splitting> + '_ {
        fields_from(self.modulus).filter_map(|field| self.split_at(field))
    }

    pub(super) fn split_at(&self, field: Field) -> Option<Splitting> {
        let mut homomorphisms: Vec<Vec<Residue>> = vec![Vec::new()];
        if self.first_root() == 1 {
            let images = cosine_images(field, self.order)?;
            homomorphisms = images.into_iter().map(|x| vec![x]).collect();
        }
        for g in self.first_root()..self.ring.generators() {
            let mut more = Vec::with_capacity(2 * homomorphisms.len());
            for images in homomorphisms {
                let root = field.sqrt(self.radicand_image(g, field, &images)?)?;
                if root == 0 {
                    return None;
                }
                for sign in [root, field.neg(root)] {
                    let mut images = images.clone();
                    images.push(sign);
                    more.push(images);
                }
            }
            homomorphisms = more;
        }
        Some(Splitting {
            field,
            homomorphisms,
        })
    }

    /// Returns, for each generator that is a root, a prime with images of the generators before it under which the
    /// radicand is not a square. This proves that the field is one. Returns `None` if the search was abandoned. A
    /// search of 2^k primes for k roots.
    #[must_use]
    pub fn witnesses(&self) -> Option<Vec<(u64, Vec<u64>)>> {
        let first = self.first_root();
        let mut found: Vec<Option<(u64, Vec<u64>)>> = vec![None; self.ring.generators() - first];
        for field in fields_from(self.order) {
            if found.iter().all(Option::is_some) {
                break;
            }
            let mut images = Vec::new();
            if first == 1 {
                let Some(all) = cosine_images(field, self.order) else {
                    continue;
                };
                images.push(all[0]);
            }
            for (g, witness) in (first..).zip(&mut found) {
                let Some(radicand) = self.radicand_image(g, field, &images).filter(|&a| a != 0)
                else {
                    break;
                };
                let Some(root) = field.sqrt(radicand) else {
                    if witness.is_none() {
                        let plain = images.iter().map(|&x| field.to_u64(x)).collect();
                        *witness = Some((field.modulus(), plain));
                    }
                    break;
                };
                images.push(root);
            }
        }
        found.into_iter().collect()
    }

    /// Returns the image of the number under the root of a generator.
    fn radicand_image(
        &self,
        generator: usize,
        field: Field,
        images: &[Residue],
    ) -> Option<Residue> {
        let constant = self.ring.relation(generator).first()?;
        let monomials = self.ring.monomials(field, images);
        Some(field.neg(constant.image_in(field, &monomials)?))
    }
}
