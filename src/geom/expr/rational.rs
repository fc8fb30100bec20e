//! Rational numbers: their size, their roots, and decimals as rationals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;
use std::sync::LazyLock;

/// Rationals wider than this stay unevaluated, so that repeated squaring cannot exhaust memory.
pub(super) const MAX_BITS: u64 = 1 << 14;

/// Decimals of π that stand for it, far more than any double has.
pub const PI_DIGITS: usize = 40;

/// The first digits of π.
pub(crate) static PI: LazyLock<BigRational> = LazyLock::new(|| {
    let digits = BigInt::from(31_415_926_535_897_932_384_626_433_832_795_028_841_u128) * 1000 + 971;
    BigRational::new(digits, BigInt::from(10).pow(40))
});

pub(super) fn bits(r: &BigRational) -> u64 {
    r.numer().bits() + r.denom().bits()
}

/// The root of a rational that is the square of a rational.
pub(crate) fn rational_sqrt(r: &BigRational) -> Option<BigRational> {
    if r.is_negative() {
        return None;
    }
    let (n, d) = (r.numer().sqrt(), r.denom().sqrt());
    (&n * &n == *r.numer() && &d * &d == *r.denom()).then(|| BigRational::new(n, d))
}

/// `whole.fraction * 10^exponent` exactly; `None` unless both parts are digits.
pub(super) fn decimal(whole: &str, fraction: &str, exponent: i64) -> Option<BigRational> {
    let digits = BigInt::parse_bytes(format!("0{whole}{fraction}").as_bytes(), 10)?;
    let exponent = exponent.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    let scale = BigInt::from(10).pow(u32::try_from(exponent.unsigned_abs()).ok()?);
    Some(if exponent < 0 {
        BigRational::new(digits, scale)
    } else {
        BigRational::from_integer(digits * scale)
    })
}
