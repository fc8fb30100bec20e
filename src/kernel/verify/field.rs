//! Confirms that the ring of a matrix is a field, so that a nonzero number in the ring is actually nonzero.

use super::certificate::{FieldClaim, Flaw};
use super::matrix::MatrixOverRing;
use super::modular::{Homomorphism, field_differs, power_modular};
use crate::linalg::number_ring::{Element, NumberRing};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// Maximum order of an angle whose polynomial is recomputed here.
const MAX_ORDER: u64 = 4096;

/// Confirms that the field is that of the matrix, and that it is a field.
pub(super) fn check_field(matrix: &MatrixOverRing, claim: &FieldClaim) -> Result<(), Flaw> {
    let ring = matrix.ring();
    let same = claim.cosine_order == matrix.cosine_order()
        && claim.relations.len() == ring.generators()
        && (0..ring.generators()).all(|g| claim.relations[g] == ring.relation(g));
    if !same {
        return Err(field_differs());
    }
    let mut first = 0;
    if let Some(order) = matrix.cosine_order() {
        if ring.generators() == 0 || !is_cosine_relation(order, ring.relation(0)) {
            return Err(Flaw::NotAField {
                generator: 0,
                why: "its relation is not the minimal polynomial of 2 cos(2π/N)",
            });
        }
        first = 1;
    }
    if claim.witnesses.len() != ring.generators() - first {
        return Err(Flaw::NotAField {
            generator: first + claim.witnesses.len().min(ring.generators() - first),
            why: "the number of witnesses differs from the number of roots",
        });
    }
    for (generator, witness) in (first..).zip(&claim.witnesses) {
        root_is_new(ring, generator, witness.prime, &witness.images)?;
    }
    Ok(())
}

/// Confirms that the number under a root is not a square in the field so far. It is not a square modulo a prime, at
/// simple roots of the relations so far. There the ring is integrally closed, so that a square of the field is a square
/// modulo the prime.
fn root_is_new(
    ring: &NumberRing,
    generator: usize,
    prime: u64,
    images: &[u64],
) -> Result<(), Flaw> {
    let flaw = |why| Flaw::NotAField { generator, why };
    let [constant, linear] = ring.relation(generator) else {
        return Err(flaw("its relation is not quadratic"));
    };
    if !linear.is_zero() {
        return Err(flaw("its relation is not that of a square root"));
    }
    let images = Homomorphism::new(prime, images, ring)?;
    images.satisfies_relation(ring, generator)?;
    if !images.are_roots_simple(ring)? {
        return Err(flaw("the prime of its witness divides a discriminant"));
    }
    let radicand = (prime - images.image_of(constant)?) % prime;
    if power_modular(radicand, (prime - 1) / 2, prime) != prime - 1 {
        return Err(flaw(
            "its radicand is a square modulo the prime of its witness",
        ));
    }
    Ok(())
}

/// Returns true if a relation is the minimal polynomial ψ of 2 cos(2π/N). With x = y + 1/y it has to become the
/// cyclotomic polynomial, y^h ψ(y + 1/y) = Φ_N(y), which is irreducible (Gauss).
fn is_cosine_relation(order: u64, relation: &[Element]) -> bool {
    if !(3..=MAX_ORDER).contains(&order) {
        return false;
    }
    let degree = relation.len();
    let Some(mut coefficients) = relation
        .iter()
        .map(|c| c.as_rational().filter(BigRational::is_integer))
        .map(|c| c.map(|c| c.to_integer()))
        .collect::<Option<Vec<BigInt>>>()
    else {
        return false;
    };
    coefficients.push(BigInt::one());
    // Horner's scheme in (y² + 1), with one more factor y for each coefficient below the leading one.
    let mut expanded: Vec<BigInt> = Vec::new();
    for (i, c) in coefficients.iter().rev().enumerate() {
        let mut next = vec![BigInt::zero(); (expanded.len() + 2).max(i + 1)];
        for (k, e) in expanded.iter().enumerate() {
            next[k] += e;
            next[k + 2] += e;
        }
        next[i] += c;
        expanded = next;
    }
    expanded.truncate(2 * degree + 1);
    expanded == cyclotomic_polynomial(order)
}

/// Returns the cyclotomic polynomial, lowest coefficient first: x^n - 1 divided by those of all proper divisors.
fn cyclotomic_polynomial(n: u64) -> Vec<BigInt> {
    let divisors: Vec<u64> = (1..=n).filter(|d| n.is_multiple_of(*d)).collect();
    let mut known: Vec<(u64, Vec<BigInt>)> = Vec::new();
    for d in divisors {
        let mut rest = vec![BigInt::zero(); usize::try_from(d).unwrap_or(0) + 1];
        rest[0] -= 1;
        if let Some(lead) = rest.last_mut() {
            *lead += 1;
        }
        for (_, divisor) in known.iter().filter(|(e, _)| d.is_multiple_of(*e)) {
            rest = divide_monic(rest, divisor);
        }
        known.push((d, rest));
    }
    known.pop().map(|(_, p)| p).unwrap_or_default()
}

/// Returns the quotient by a monic polynomial that divides.
fn divide_monic(mut a: Vec<BigInt>, b: &[BigInt]) -> Vec<BigInt> {
    let length = (a.len() + 1).saturating_sub(b.len());
    let mut quotient = vec![BigInt::zero(); length];
    for low in (0..length).rev() {
        let q = a[low + b.len() - 1].clone();
        for (x, y) in a[low..].iter_mut().zip(b) {
            *x -= &q * y;
        }
        quotient[low] = q;
    }
    quotient
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_cosines() {
        let is = |order, relation: &[i64]| {
            let relation: Vec<Element> =
                relation.iter().map(|&c| Element::from_integer(c)).collect();
            is_cosine_relation(order, &relation)
        };
        assert!(is(3, &[1]) && is(4, &[0]) && is(6, &[-1]));
        assert!(is(5, &[-1, 1]) && is(8, &[-2, 0]) && is(12, &[-3, 0]));
        assert!(is(7, &[-1, -2, 1]) && is(9, &[1, -3, 0]));
        assert!(is(20, &[5, 0, -5, 0]));
        assert!(!is(5, &[1, 1]) && !is(8, &[-3, 0]) && !is(7, &[-1, 1]) && !is(20, &[-1, 1]));
        assert!(!is(5000, &[0]) && !is(1, &[-2]));
        assert_eq!(cyclotomic_polynomial(105)[7], BigInt::from(-2));
    }
}
