//! Linear algebra over a prime field: exact zero tests at machine speed; and exact arithmetic in number rings, with rational numbers as
//! whole ones over a denominator that they have in common.

pub mod echelon;
pub(crate) mod exterior;
pub mod modp;
pub mod number_ring;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::One;

/// The least denominator that numbers have in common. O(length) divisions, and a greatest common divisor for each that does not divide
/// what those before it have.
#[must_use]
pub fn common_denominator<'a>(all: impl IntoIterator<Item = &'a BigRational>) -> BigInt {
    let all = all.into_iter();
    all.fold(BigInt::one(), |m, x| common_multiple(m, x.denom()))
}

/// The least common multiple of two positive numbers. A division tells most often, and costs much less than a divisor.
#[must_use]
pub fn common_multiple(m: BigInt, n: &BigInt) -> BigInt {
    if m.is_multiple_of(n) { m } else { m.lcm(n) }
}

/// How often a denominator that a number's own divides goes into the number. O(length).
#[must_use]
pub fn whole(x: &BigRational, denominator: &BigInt) -> BigInt {
    if x.denom() == denominator {
        x.numer().clone()
    } else {
        x.numer() * (denominator / x.denom())
    }
}
