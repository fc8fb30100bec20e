//! Ratios written as decimals, and the fractions they intend.

use crate::geom::expr::{End, Expr, WrittenNumber};
use crate::model::joint_type::Coupling;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{FromPrimitive, One, Signed, ToPrimitive, Zero};

/// Probability that a random number is this close to a fraction, below which the fraction is not a coincidence.
const LIKELY: f64 = 0.1;
/// Number of digits from which on a ratio is not arbitrary.
const LONG: usize = 4;

/// A ratio whose written value is doubtful.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// Half a unit of its last digit.
    pub half: f64,
    /// The simplest fraction within that range.
    pub fraction: BigRational,
    /// Whether it is so simple that it is not a coincidence.
    pub likely: bool,
}

impl Doubt {
    /// Returns the fraction if it is not a coincidence.
    #[must_use]
    pub fn simple_fraction(&self) -> Option<&BigRational> {
        Some(&self.fraction).filter(|_| self.likely)
    }
}

/// Returns the doubt about a ratio: a decimal that is almost a simple fraction, -0.6667 for -2/3, or so long that it
/// was rounded. Returns `None` for a fraction or whole number, or the simplest number within its digits: -1.5, 0.125.
///
/// # Complexity
/// O(digits) divisions.
///
/// # Examples
/// ```
/// use ozols::model::rounded::ratio::doubt_ratio;
/// let doubt = doubt_ratio(&"-0.6667".parse()?);
/// assert_eq!(doubt.map(|d| d.fraction.to_string()).as_deref(), Some("-2/3"));
/// assert!(doubt_ratio(&"0.125".parse()?).is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn doubt_ratio(ratio: &Expr) -> Option<Doubt> {
    let WrittenNumber::Decimal(digits) = ratio.written() else {
        return None;
    };
    let value = ratio.rational_ref().filter(|_| digits.end != End::Float)?;
    let half = BigRational::from_f64(digits.half)?;
    let (low, high) = (value.abs() - &half, value.abs() + &half);
    if !low.is_positive() {
        return None;
    }
    let size = simplest_between(&low, &high);
    if size == value.abs() {
        return None;
    }
    let denominator = size.denom().to_f64().unwrap_or(f64::INFINITY);
    let chance = denominator * denominator * 2.0 * digits.half;
    let likely = chance <= LIKELY;
    if !likely && digits.significant < LONG {
        return None;
    }
    let fraction = if value.is_negative() { -size } else { size };
    Some(Doubt {
        half: digits.half,
        fraction,
        likely,
    })
}

/// Returns the doubt about the ratio of a coupling. Between a turn and a slide a ratio is a length, and it is doubtful
/// only if it is almost a simple fraction.
#[must_use]
pub fn doubt_of(coupling: &Coupling) -> Option<Doubt> {
    let [a, b] = coupling.ends.map(|e| e.freedom.is_slide());
    doubt_ratio(&coupling.ratio).filter(|d| d.likely || a == b)
}

/// Returns the fraction with the smallest denominator between one positive number and a larger one.
///
/// # Sources
/// Graham, Knuth & Patashnik, "Concrete Mathematics", 1994, 4.5: the Stern-Brocot tree, as continued fractions.
fn simplest_between(low: &BigRational, high: &BigRational) -> BigRational {
    let (mut low, mut high) = (low.clone(), high.clone());
    let mut parts: Vec<BigInt> = Vec::new();
    let last = loop {
        let whole = low.ceil().to_integer();
        if BigRational::from_integer(whole.clone()) <= high {
            break whole;
        }
        let part = low.numer().div_floor(low.denom());
        let of = |x: &BigRational| (x - BigRational::from_integer(part.clone())).recip();
        (low, high) = (of(&high), of(&low));
        parts.push(part);
    };
    let (mut n, mut d) = (last, BigInt::one());
    for part in parts.into_iter().rev() {
        (n, d) = (part * &n + d, n);
    }
    if d.is_zero() {
        BigRational::zero()
    } else {
        BigRational::new(n, d)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_that_stand_for_fractions_are_doubted() {
        let meant =
            |s: &str| doubt_ratio(&s.parse::<Expr>().unwrap()).map(|d| d.fraction.to_string());
        for (text, fraction) in [
            ("-0.6667", "-2/3"),
            ("0.33", "1/3"),
            ("1.4286", "10/7"),
            ("0.167", "1/6"),
        ] {
            assert_eq!(meant(text).as_deref(), Some(fraction), "{text}");
        }
        for exact in [
            "-2/3",
            "1001/1000",
            "123456789/10^20",
            "-1.5",
            "0.5",
            "0.125",
            "2.75",
            "3",
            "2.0",
            "0.35",
        ] {
            assert_eq!(meant(exact), None, "{exact}");
        }
        assert!(meant("0.4521").is_some());
    }
}
