//! Rational numbers from their residues modulo several primes.
//!
//! # Sources
//! von zur Gathen & Gerhard, "Modern Computer Algebra", 5.10 (rational reconstruction), 5.4 (Chinese remainders).

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::linalg::modp::{Field, Residue};

/// Number of bits by which a fraction must be shorter than the modulus. One residue in 2^24 has such a fraction by
/// chance.
const SPARE_BITS: u64 = 24;

/// Returns the fraction n/d ≡ x modulo m with |n| and d at most sqrt(m/2), which is unique if it exists.
///
/// Runs half of Euclid's algorithm on m and x, in O(log² m) bit operations.
#[must_use]
pub(crate) fn reconstruct_rational(x: &BigInt, m: &BigInt) -> Option<BigRational> {
    let bound = (m / 2u32).sqrt();
    let (mut r0, mut r1) = (m.clone(), x.mod_floor(m));
    let (mut t0, mut t1) = (BigInt::zero(), BigInt::one());
    while r1 > bound {
        let (q, r) = r0.div_rem(&r1);
        let t = t0 - q * &t1;
        (r0, r1) = (r1, r);
        (t0, t1) = (t1, t);
    }
    if t1.is_zero() || t1.abs() > bound || !r1.gcd(&t1).is_one() {
        return None;
    }
    // The fraction is in lowest terms, with the sign in the numerator.
    Some(if t1.is_negative() {
        BigRational::new_raw(-r1, -t1)
    } else {
        BigRational::new_raw(r1, t1)
    })
}

/// The primes so far and their product.
#[derive(Debug, Clone)]
pub(crate) struct Modulus {
    product: BigInt,
    primes: usize,
}

impl Default for Modulus {
    fn default() -> Self {
        Modulus {
            product: BigInt::one(),
            primes: 0,
        }
    }
}

impl Modulus {
    /// Returns the number of primes. O(1).
    #[must_use]
    pub(crate) fn primes(&self) -> usize {
        self.primes
    }

    /// Adds one more prime, after all unknowns have seen it. O(primes).
    pub(crate) fn extend(&mut self, field: Field) {
        self.product *= field.modulus();
        self.primes += 1;
    }
}

/// A rational number to be reconstructed from its residues.
#[derive(Debug, Clone)]
pub(crate) enum Unknown {
    /// A fraction that agrees with all residues so far.
    Settled(BigRational),
    /// The residue modulo the product of the primes so far.
    Open(BigInt),
}

impl Default for Unknown {
    fn default() -> Self {
        Unknown::Settled(BigRational::zero())
    }
}

impl Unknown {
    /// Adds the residue modulo one more prime. Returns false if it contradicts the settled fraction. `inverse` is the
    /// inverse of the product of the earlier primes, in the field. O(primes) if open, O(size of the fraction) if
    /// settled.
    pub(crate) fn see_residue(
        &mut self,
        field: Field,
        residue: Residue,
        modulus: &Modulus,
        inverse: Residue,
    ) -> bool {
        let agrees = match self {
            Unknown::Settled(q) if q.is_zero() => residue == 0,
            Unknown::Settled(q) => field.from_rational(q) == Some(residue),
            Unknown::Open(_) => false,
        };
        if agrees {
            return true;
        }
        let before = match std::mem::take(self) {
            Unknown::Settled(q) => {
                // The denominator was invertible modulo every prime so far.
                let m = &modulus.product;
                let inverse = q.denom().modinv(m).unwrap_or_default();
                (q.numer() * inverse).mod_floor(m)
            }
            Unknown::Open(x) => x,
        };
        let step = field.mul(field.sub(residue, field.from_bigint(&before)), inverse);
        *self = Unknown::Open(before + &modulus.product * field.to_u64(step));
        false
    }

    /// Settles on a fraction if there is one too short to arise by chance, and returns the outcome.
    ///
    /// `denominator` is tried first, and becomes a multiple of the one found. The numbers of a vector mostly share one,
    /// and a product is much cheaper than Euclid's algorithm. O(primes²) if open.
    pub(crate) fn settle_fraction(
        &mut self,
        modulus: &Modulus,
        denominator: &mut BigInt,
    ) -> Settled {
        let Unknown::Open(x) = self else {
            return Settled::Before;
        };
        let m = &modulus.product;
        let short = |n: &BigInt, d: &BigInt| n.bits() + d.bits() + SPARE_BITS <= m.bits();
        let mut numerator = (&*x * &*denominator).mod_floor(m);
        if &numerator * 2u32 > *m {
            numerator -= m;
        }
        if short(&numerator, denominator) {
            *self = Unknown::Settled(BigRational::new(numerator, denominator.clone()));
            return Settled::Cheaply;
        }
        match reconstruct_rational(x, m).filter(|q| short(q.numer(), q.denom())) {
            Some(q) => {
                *denominator = denominator.lcm(q.denom());
                *self = Unknown::Settled(q);
                Settled::Newly
            }
            None => Settled::NotYet,
        }
    }
}

/// Outcome of an attempt to settle on a fraction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Settled {
    /// The number was settled before.
    Before,
    /// The given denominator was enough.
    Cheaply,
    /// Euclid's algorithm found the fraction.
    Newly,
    /// The fraction is still too long.
    NotYet,
}

/// Returns the inverse of the product of the primes so far, in the field of another prime. O(primes).
#[must_use]
pub(crate) fn inverse_of(modulus: &Modulus, field: Field) -> Option<Residue> {
    let residue = field.from_bigint(&modulus.product);
    (residue != 0).then(|| field.inv(residue))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::modp::is_prime;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn fractions_come_back_from_their_residues(n in any::<i128>(), d in 1u64.., far in any::<bool>()) {
            let q = BigRational::new(n.into(), d.into());
            let q = if far { &q * &q } else { q };
            let mut unknown = Unknown::default();
            let mut modulus = Modulus::default();
            let mut quiet = 0;
            for p in (1u64 << 61..).filter(|&p| is_prime(p)).take(12) {
                let f = Field::new(p);
                let agreed = unknown.see_residue(f, f.from_rational(&q).unwrap(), &modulus, inverse_of(&modulus, f).unwrap());
                quiet = if agreed { quiet + 1 } else { 0 };
                modulus.extend(f);
                unknown.settle_fraction(&modulus, &mut BigInt::one());
            }
            prop_assert!(quiet > 2);
            prop_assert!(matches!(unknown, Unknown::Settled(x) if x == q));
        }
    }
}
