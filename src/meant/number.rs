//! Rational numbers near doubles, and vectors of them.

use crate::geom::vector::Vector;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

/// A vector of rational numbers.
pub type Rational3 = [BigRational; 3];

/// The decimal of so many places nearest to a number that is finite.
pub(super) fn decimal(x: f64, places: u32) -> BigRational {
    let Some(exact) = BigRational::from_float(x) else {
        return BigRational::zero();
    };
    let scale = BigRational::from_integer(BigInt::from(10).pow(places));
    (exact * &scale).round() / scale
}

/// The nearest doubles.
pub(super) fn to_f64(v: &Rational3) -> Vector {
    v.each_ref().map(|x| x.to_f64().unwrap_or(f64::NAN))
}

pub(super) fn cross(a: &Rational3, b: &Rational3) -> Rational3 {
    let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

pub(super) fn is_zero(v: &Rational3) -> bool {
    v.iter().all(Zero::is_zero)
}

pub(super) fn axes() -> [Rational3; 3] {
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|v| v.map(|x| BigRational::from_integer(BigInt::from(x))))
}

/// A direction with its largest component 1.
pub(super) fn scaled(v: Rational3) -> Rational3 {
    use num_traits::Signed;
    let largest = v.iter().map(Signed::abs).max();
    match largest.filter(|m| !m.is_zero()) {
        Some(m) => v.map(|x| x / &m),
        None => v,
    }
}
