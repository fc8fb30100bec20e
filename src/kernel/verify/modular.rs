//! Simple arithmetic modulo a prime below 2^63, in 128 bits.

use super::certificate::Flaw;
use crate::linalg::number_ring::{Element, NumberRing};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// Returns the product modulo p.
pub(super) fn multiply_modular(a: u64, b: u64, p: u64) -> u64 {
    let product = u128::from(a) * u128::from(b) % u128::from(p);
    u64::try_from(product).unwrap_or(0)
}

/// Returns the sum modulo p.
pub(super) fn add_modular(a: u64, b: u64, p: u64) -> u64 {
    let sum = (u128::from(a) + u128::from(b)) % u128::from(p);
    u64::try_from(sum).unwrap_or(0)
}

/// Returns the power modulo p.
pub(super) fn power_modular(mut base: u64, mut exponent: u64, p: u64) -> u64 {
    let mut out = 1 % p;
    while exponent > 0 {
        if exponent % 2 == 1 {
            out = multiply_modular(out, base, p);
        }
        base = multiply_modular(base, base, p);
        exponent /= 2;
    }
    out
}

/// Returns true if p is a prime with 2 < p < 2^63 (strong pseudoprime test with the twelve bases that decide 64 bits).
///
/// # Sources
/// Sorenson & Webster, "Strong pseudoprimes to twelve prime bases", Math. Comp. 86 (2017).
pub(super) fn is_odd_prime(p: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if p < 3 || p.is_multiple_of(2) || p >> 63 == 1 {
        return false;
    }
    if BASES.contains(&p) {
        return true;
    }
    let (twos, odd) = (
        (p - 1).trailing_zeros(),
        (p - 1) >> (p - 1).trailing_zeros(),
    );
    BASES.iter().all(|&base| {
        let mut x = power_modular(base, odd, p);
        if x == 1 {
            return true;
        }
        for _ in 0..twos {
            if x == p - 1 {
                return true;
            }
            x = multiply_modular(x, x, p);
        }
        false
    })
}

/// Returns the flaw of a certificate for another number field.
pub(super) fn field_differs() -> Flaw {
    Flaw::Malformed("its number field is not that of the matrix".to_owned())
}

fn wrong_images(prime: u64, wanted: usize, given: usize) -> Flaw {
    Flaw::Malformed(format!(
        "{given} images of generators modulo {prime} do not fit the {wanted} of the field"
    ))
}

/// Images of the generators of a ring in a prime field.
#[derive(Debug)]
pub(super) struct Homomorphism {
    prime: u64,
    images: Vec<u64>,
    /// Images of the basis elements formed from the given generators.
    basis: Vec<u64>,
}

impl Homomorphism {
    /// Creates the images of the first generators of a ring: of all of them, or of as many as are given.
    /// [`Homomorphism::respects`] checks the number.
    pub(super) fn new(prime: u64, images: &[u64], ring: &NumberRing) -> Result<Homomorphism, Flaw> {
        if !is_odd_prime(prime) {
            let why = format!("{prime} is not a prime between 3 and 2^63");
            return Err(Flaw::Malformed(why));
        }
        if images.len() > ring.generators() || images.iter().any(|&x| x >= prime) {
            return Err(wrong_images(prime, ring.generators(), images.len()));
        }
        let mut basis = vec![1];
        for (generator, &image) in images.iter().enumerate() {
            let below = basis.clone();
            let mut factor = 1;
            for _ in 1..ring.relation(generator).len() {
                factor = multiply_modular(factor, image, prime);
                basis.extend(below.iter().map(|&b| multiply_modular(b, factor, prime)));
            }
        }
        Ok(Homomorphism {
            prime,
            images: images.to_vec(),
            basis,
        })
    }

    /// Confirms that exactly the first `count` generators have images, and that these satisfy their relations.
    pub(super) fn satisfies_relation(&self, ring: &NumberRing, count: usize) -> Result<(), Flaw> {
        if self.images.len() != count {
            return Err(wrong_images(self.prime, count, self.images.len()));
        }
        for (generator, &x) in self.images.iter().enumerate() {
            // Horner, from the leading 1 down
            let mut value = 1;
            for c in ring.relation(generator).iter().rev() {
                value = add_modular(
                    multiply_modular(value, x, self.prime),
                    self.image_of(c)?,
                    self.prime,
                );
            }
            if value != 0 {
                return Err(Flaw::Malformed(format!(
                    "the image of generator {generator} modulo {} does not satisfy its relation",
                    self.prime
                )));
            }
        }
        Ok(())
    }

    /// Returns true if no image is a multiple root of its relation.
    pub(super) fn are_roots_simple(&self, ring: &NumberRing) -> Result<bool, Flaw> {
        for (generator, &x) in self.images.iter().enumerate() {
            let (relation, p) = (ring.relation(generator), self.prime);
            let mut slope = relation.len() as u64 % p;
            for (k, c) in relation.iter().enumerate().skip(1).rev() {
                slope = add_modular(
                    multiply_modular(slope, x, p),
                    multiply_modular(k as u64 % p, self.image_of(c)?, p),
                    p,
                );
            }
            if slope == 0 {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Returns the image of an element formed from the generators that have one.
    pub(super) fn image_of(&self, element: &Element) -> Result<u64, Flaw> {
        let mut sum = 0;
        for (i, q) in element.coordinates().iter().enumerate() {
            let monomial = *self.basis.get(i).ok_or_else(field_differs)?;
            let term = multiply_modular(self.of_rational(q)?, monomial, self.prime);
            sum = add_modular(sum, term, self.prime);
        }
        Ok(sum)
    }

    fn of_rational(&self, q: &BigRational) -> Result<u64, Flaw> {
        let p = self.prime;
        let residue = |x: &BigInt| x.mod_floor(&BigInt::from(p)).to_u64().unwrap_or(0);
        let below = residue(q.denom());
        if below == 0 {
            return Err(Flaw::Denominator { prime: p });
        }
        Ok(multiply_modular(
            residue(q.numer()),
            power_modular(below, p - 2, p),
            p,
        ))
    }
}

/// Returns true if the determinant of a square matrix vanishes modulo p, by elimination. O(n³).
pub(super) fn is_singular(mut m: Vec<Vec<u64>>, p: u64) -> bool {
    let size = m.len();
    for c in 0..size {
        let Some(r) = (c..size).find(|&r| m[r][c] != 0) else {
            return true;
        };
        m.swap(c, r);
        let pivot = m[c].clone();
        let inverse = power_modular(pivot[c], p - 2, p);
        for row in m.iter_mut().skip(c + 1).filter(|row| row[c] != 0) {
            // row += (p - row[c] / pivot[c]) · pivot
            let by = p - multiply_modular(row[c], inverse, p);
            for (x, &y) in row.iter_mut().zip(&pivot).skip(c) {
                *x = add_modular(*x, multiply_modular(by, y, p), p);
            }
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primes_are_told_from_composites() {
        for p in 0..2000u64 {
            let prime = p > 2 && (2..p).all(|d| p % d != 0);
            assert_eq!(is_odd_prime(p), prime, "{p}");
        }
        assert!(is_odd_prime((1 << 61) - 1));
        // a strong pseudoprime to the first nine bases
        assert!(!is_odd_prime(3_825_123_056_546_413_051));
    }

    #[test]
    fn determinants_modulo_small_primes() {
        assert!(is_singular(vec![vec![1, 2], vec![3, 6]], 7));
        assert!(!is_singular(vec![vec![0, 2], vec![3, 6]], 7));
        // determinant -7
        assert!(is_singular(vec![vec![1, 3], vec![3, 2]], 7));
        assert!(!is_singular(vec![vec![1, 3], vec![3, 2]], 5));
        assert!(!is_singular(Vec::new(), 5));
    }
}
