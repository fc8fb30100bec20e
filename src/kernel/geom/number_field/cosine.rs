//! Minimal polynomials of cosines.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::geom::exact::radical::prime_factors;
use crate::linalg::number_ring::Element;

/// Returns the minimal polynomial of 2 cos(2π/n) for n > 2, lowest coefficient first, without the leading 1.
///
/// With h = φ(n)/2, the cyclotomic polynomial divided by x^h is a sum of terms x^k + x^-k, which are polynomials in x +
/// 1/x.
pub(super) fn cosine_relation(n: u64) -> Vec<Element> {
    let cyclotomic = cyclotomic_polynomial(n);
    let h = cyclotomic.len() / 2;
    let mut sum = vec![BigInt::zero(); h + 1];
    // x^k + x^-k for k and k + 1 as polynomials in t = x + 1/x; half of the first, because the middle term is single.
    let mut now = vec![BigInt::one()];
    let mut next = vec![BigInt::zero(), BigInt::one()];
    for k in 0..=h {
        for (s, v) in sum.iter_mut().zip(&now) {
            *s += v * &cyclotomic[h + k];
        }
        let mut after = vec![BigInt::zero(); next.len() + 1];
        for (i, v) in next.iter().enumerate() {
            after[i + 1] += v;
        }
        let twice = if k == 0 { 2 } else { 1 };
        for (i, v) in now.iter().enumerate() {
            after[i] -= v * twice;
        }
        (now, next) = (next, after);
    }
    sum.pop();
    sum.into_iter()
        .map(|c| Element::from_rational(BigRational::from_integer(c)))
        .collect()
}

/// Returns the cyclotomic polynomial by Möbius inversion: the product of (x^d - 1)^μ(n/d) over the divisors d.
fn cyclotomic_polynomial(n: u64) -> Vec<BigInt> {
    let primes: Vec<u64> = prime_factors(n).into_iter().map(|(q, _)| q).collect();
    let (mut over, mut under) = (Vec::new(), Vec::new());
    for subset in 0..1u32 << primes.len() {
        let chosen = |i: &usize| subset >> i & 1 == 1;
        let product: u64 = (0..primes.len())
            .filter(chosen)
            .map(|i| primes[i])
            .product();
        let d = usize::try_from(n / product).unwrap_or(usize::MAX);
        if subset.count_ones() % 2 == 0 {
            over.push(d)
        } else {
            under.push(d)
        }
    }
    let mut out = vec![BigInt::one()];
    for d in over {
        let mut product = vec![BigInt::zero(); out.len() + d];
        for (i, c) in out.iter().enumerate() {
            product[i + d] += c;
            product[i] -= c;
        }
        out = product;
    }
    for d in under {
        // c = q · (x^d - 1), from the top down
        let mut quotient = out.split_off(d);
        for i in (0..quotient.len().saturating_sub(d)).rev() {
            let above = quotient[i + d].clone();
            quotient[i] += above;
        }
        out = quotient;
    }
    out
}
