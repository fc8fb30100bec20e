//! Rational numbers: their size, their roots, and decimals as rationals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use std::sync::LazyLock;

/// Maximum size of an evaluated rational, in bits. Larger ones stay unevaluated, so that repeated squaring cannot
/// exhaust memory.
pub(super) const MAX_BITS: u64 = 1 << 14;
/// Maximum length of a fraction of two whole numbers in a text. Exact geometry of rounded files has long ones.
const MAX_FRACTION: usize = 4800;

/// Number of decimals used for π, far more than any double has.
pub const PI_DIGITS: usize = 40;

/// The first digits of π.
pub(crate) static PI: LazyLock<BigRational> = LazyLock::new(|| {
    let digits = BigInt::from(31_415_926_535_897_932_384_626_433_832_795_028_841_u128) * 1000 + 971;
    BigRational::new(digits, BigInt::from(10).pow(40))
});

pub(super) fn bit_size(r: &BigRational) -> u64 {
    r.numer().bits() + r.denom().bits()
}

/// Returns the root of a rational that is the square of a rational.
pub(crate) fn rational_sqrt(r: &BigRational) -> Option<BigRational> {
    if r.is_negative() {
        return None;
    }
    let (n, d) = (r.numer().sqrt(), r.denom().sqrt());
    (&n * &n == *r.numer() && &d * &d == *r.denom()).then(|| BigRational::new(n, d))
}

/// Returns `whole.fraction * 10^exponent` exactly, or `None` unless both parts are digits.
pub(super) fn rational_from_decimal(
    whole: &str,
    fraction: &str,
    exponent: i64,
) -> Option<BigRational> {
    let digits = BigInt::parse_bytes(format!("0{whole}{fraction}").as_bytes(), 10)?;
    let exponent = exponent.checked_sub(i64::try_from(fraction.len()).ok()?)?;
    let scale = BigInt::from(10).pow(u32::try_from(exponent.unsigned_abs()).ok()?);
    Some(if exponent < 0 {
        BigRational::new(digits, scale)
    } else {
        BigRational::from_integer(digits * scale)
    })
}

/// Reads a fraction of two whole numbers and nothing else. Also returns `None` if it is wider than rationals may be.
pub(super) fn parse_fraction(text: &str) -> Option<BigRational> {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text),
    };
    let (numer, denom) = digits.split_once('/')?;
    let whole = |t: &str| {
        let digits = t.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| BigInt::parse_bytes(t.as_bytes(), 10))?
    };
    if text.len() > MAX_FRACTION {
        return None;
    }
    let (numer, denom) = (whole(numer)?, whole(denom)?);
    if denom.is_zero() {
        return None;
    }
    Some(BigRational::new(numer * sign, denom)).filter(|r| bit_size(r) <= MAX_BITS)
}

#[cfg(test)]
mod tests {
    use crate::geom::expr::Expr;

    #[test]
    fn long_fractions_are_read_again_and_endless_ones_refused() {
        // Exact geometry of rounded files has both parts beyond the range of doubles.
        let long = format!("-{}/{}7", "12345".repeat(140), "98765".repeat(141));
        let e: Expr = long.parse().expect("a fraction");
        let near = -12345.0 / 98765.0 * 1e-6;
        assert!((e.to_f64() / near - 1.0).abs() < 1e-4, "{}", e.to_f64());
        let again: Expr = e.to_string().parse().expect("the same");
        assert_eq!(e.as_rational(), again.as_rational());
        for text in [
            format!("1/{}", "0".repeat(900)),
            format!("1/{}", "7".repeat(6000)),
            format!("{}/3", "7".repeat(900)),
            format!("sqrt(1/{})", "7".repeat(1200)),
        ] {
            assert!(text.parse::<Expr>().is_err(), "{text}");
        }
    }
}
