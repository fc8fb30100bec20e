//! Coordinates that were measured or computed in floating point, told by their many digits.
//!
//! Exact ranks take every digit at its word, so an axis that is parallel to another but for the last rounding error
//! counts as tilted, and constraints that are redundant in truth count as independent.

use crate::geom::expr::Expr;
use crate::model::mechanism::{Frame, Mechanism, Mode};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed};
use std::fmt;

/// Decimals with so many significant digits are taken to be measured.
pub const DIGITS: usize = 9;

/// Why a mechanism looks measured.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Measured {
    /// How many coordinates look so.
    pub coordinates: usize,
    /// Where the first of them is, such as `axis of joint 2-3`.
    pub place: String,
    /// Its value as text.
    pub value: String,
    /// The fewest digits among those coordinates: how finely they are rounded.
    pub digits: usize,
}

impl Measured {
    /// A relative tolerance that rounding errors of that many digits stay below, at least 1e-9 and at most 1e-6.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        let digits = i32::try_from(self.digits).unwrap_or(i32::MAX);
        10f64.powi(2 - digits.min(300)).clamp(1e-9, 1e-6)
    }
}

impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the {} has {}", self.place, self.value)?;
        match self.coordinates {
            0 | 1 => Ok(()),
            n => write!(f, ", and {} more coordinates are like it", n - 1),
        }
    }
}

/// Whether some coordinate of the joints, their options, or the plane is a decimal with at least [`DIGITS`] significant
/// digits. Fractions and roots written as such are exact however long their decimals are.
#[must_use]
pub fn looks_measured(mechanism: &Mechanism) -> Option<Measured> {
    let mut found: Option<Measured> = None;
    let mut see = |v: &Expr, place: &dyn Fn() -> String| {
        let Some(digits) = significant_digits(v).filter(|d| *d >= DIGITS) else {
            return;
        };
        match &mut found {
            Some(m) => {
                m.coordinates += 1;
                m.digits = m.digits.min(digits);
            }
            None => {
                found = Some(Measured {
                    coordinates: 1,
                    place: place(),
                    value: format!("{:?}", v.to_f64()),
                    digits,
                });
            }
        }
    };
    let mut frame = |f: &Frame, at: &dyn Fn() -> String| {
        for (what, vector) in [
            ("point", &f.point),
            ("axis", &f.axis),
            ("reference", &f.reference),
        ] {
            for c in vector {
                see(c, &|| format!("{what} of {}", at()));
            }
        }
        see(&f.pitch, &|| format!("pitch of {}", at()));
    };
    for joint in &mechanism.joints {
        frame(&joint.frame, &|| format!("joint {}", joint.id));
        // Options mostly share the joint's place; only what is their own counts.
        for o in joint.options.iter().chain(&joint.unloading) {
            let own = |a: &[Expr; 3], b: &[Expr; 3]| {
                a.iter().zip(b).any(|(a, b)| a.to_f64() != b.to_f64())
            };
            if own(&o.frame.point, &joint.frame.point)
                || own(&o.frame.axis, &joint.frame.axis)
                || own(&o.frame.reference, &joint.frame.reference)
                || o.frame.pitch.to_f64() != joint.frame.pitch.to_f64()
            {
                frame(&o.frame, &|| {
                    format!("option {} of joint {}", o.name, joint.id)
                });
            }
        }
    }
    if let Mode::Planar { normal } = &mechanism.mode {
        for c in normal {
            see(c, &|| "normal of the plane".to_owned());
        }
    }
    found
}

/// Significant digits of a decimal; `None` for roots, for fractions that no decimal ends (and halves of halves, which
/// are written as fractions), and for whole numbers.
fn significant_digits(expr: &Expr) -> Option<usize> {
    let r = expr.as_rational()?;
    let (five, mut rest, mut fives) = (BigInt::from(5), r.denom().clone(), 0u32);
    let twos = rest.trailing_zeros().unwrap_or(0);
    rest >>= twos;
    while fives < 400 {
        let (quotient, left) = rest.div_rem(&five);
        if left != BigInt::ZERO {
            break;
        }
        rest = quotient;
        fives += 1;
    }
    if !rest.is_one() || fives == 0 {
        return None;
    }
    let places = fives.max(u32::try_from(twos).ok()?);
    let scaled = r.numer().abs() * BigInt::from(10).pow(places) / r.denom();
    Some(scaled.to_string().trim_end_matches('0').len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_decimals_look_measured() {
        let digits = |s: &str| significant_digits(&s.parse::<Expr>().unwrap());
        assert_eq!(digits("0.8660254037844386"), Some(16));
        assert_eq!(digits("-12.7"), Some(3));
        assert_eq!(digits("1e-9"), Some(1));
        assert_eq!(digits("0.000123456789"), Some(9));
        for exact in ["1/3", "sqrt(3)/2", "1/4096", "123456789012", "cos(36deg)"] {
            assert_eq!(digits(exact), None, "{exact}");
        }
    }

    #[test]
    fn the_tolerance_follows_the_digits() {
        let with = |digits| Measured {
            coordinates: 1,
            place: String::new(),
            value: String::new(),
            digits,
        };
        assert_eq!(with(16).tolerance(), 1e-9);
        assert!((with(9).tolerance() - 1e-7).abs() < 1e-20);
    }
}
