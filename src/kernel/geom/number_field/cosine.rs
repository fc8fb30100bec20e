//! Prime fields with roots of unity, and the minimal polynomials of cosines.

use crate::geom::exact::plan::root_of_unity;
use crate::geom::exact::radical::prime_factors;
use crate::linalg::modp::{Field, Residue, is_prime};
use crate::linalg::number_ring::Element;
use num_integer::Integer;

/// Maximum number of candidates in the search for primes.
const MAX_CANDIDATES: u64 = 1 << 20;

/// Returns the images of 2 cos(2πk/n) for all k coprime to n, in a field with the roots of unity.
pub(super) fn cosine_images(field: Field, n: u64) -> Option<Vec<Residue>> {
    let primes: Vec<u64> = prime_factors(n).into_iter().map(|(q, _)| q).collect();
    let zeta = root_of_unity(field, n, &primes)?;
    let inverse = field.inv(zeta);
    let coprime = (1..n / 2).filter(|k| k.gcd(&n) == 1);
    let image = |k| field.add(field.pow(zeta, k), field.pow(inverse, k));
    Some(coprime.map(image).collect())
}

/// Returns the minimal polynomial of 2 cos(2π/n) for n > 4, lowest coefficient first, without the leading 1: from its
/// roots modulo a prime that is larger than its coefficients. Whoever checks a certificate computes it in another way.
pub(super) fn cosine_relation(n: u64) -> Option<Vec<Element>> {
    let field = fields_from(n).next()?;
    let mut product = vec![field.one()];
    for root in cosine_images(field, n)? {
        let mut next = vec![0; product.len() + 1];
        for (i, &c) in product.iter().enumerate() {
            next[i + 1] = field.add(next[i + 1], c);
            next[i] = field.sub(next[i], field.mul(c, root));
        }
        product = next;
    }
    product.pop();
    let integer = |c: Residue| match field.to_u64(c).cast_signed() {
        x if x > field.modulus().cast_signed() / 2 => x - field.modulus().cast_signed(),
        x => x,
    };
    let integers = product.into_iter().map(integer);
    Some(integers.map(Element::from_integer).collect())
}

/// Returns the fields of primes 1 modulo a number, from 2^61 on.
pub(super) fn fields_from(modulus: u64) -> impl Iterator<Item = Field> {
    let start = (1u64 << 61) / modulus + 1;
    let end = ((1u64 << 62) - 1) / modulus;
    (start..end.min(start.saturating_add(MAX_CANDIDATES)))
        .map(move |k| k * modulus + 1)
        .filter(|&p| is_prime(p))
        .map(Field::new)
}
