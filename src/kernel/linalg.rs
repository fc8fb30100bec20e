//! Linear algebra over a prime field, with exact zero tests at machine speed. Also exact arithmetic in number rings,
//! with rational numbers as integers over a common denominator.

pub mod echelon;
pub mod modp;
pub mod number_ring;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::One;

/// Returns the least common denominator of some numbers. O(length) divisions, and one greatest common divisor for each
/// denominator that does not divide the previous result.
#[must_use]
pub fn common_denominator<'a>(all: impl IntoIterator<Item = &'a BigRational>) -> BigInt {
    let all = all.into_iter();
    all.fold(BigInt::one(), |m, x| common_multiple(m, x.denom()))
}

/// Returns the least common multiple of two positive numbers. A division mostly decides, and costs much less than a
/// greatest common divisor.
#[must_use]
pub fn common_multiple(m: BigInt, n: &BigInt) -> BigInt {
    if m.is_multiple_of(n) { m } else { m.lcm(n) }
}

/// Returns a number times a denominator that its own denominator divides. O(length).
#[must_use]
pub fn whole_over(x: &BigRational, denominator: &BigInt) -> BigInt {
    if x.denom() == denominator {
        x.numer().clone()
    } else {
        x.numer() * (denominator / x.denom())
    }
}
