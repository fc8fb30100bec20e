//! Detection of coordinates that were rounded, measured or computed in floating point, by their digits.
//!
//! Exact ranks take every digit as written. So an axis that is parallel to another except for the last digit counts as
//! tilted, and constraints that are actually redundant count as independent.

mod class;
pub mod ratio;
mod source;
mod uncertainty;

pub use class::{LONG_DIRECTION, LONG_LENGTH};
pub use source::{Largest, Sources};
pub use uncertainty::{FrameUncertainty, Uncertainties, uncertainties};

use crate::geom::expr::{End, Expr, PI_DIGITS, WrittenNumber};
use crate::geom::vector::to_vector;
use crate::model::mechanism::{Frame, Mechanism, Mode};
use class::NumberKind;
use std::fmt;

/// Decimals with at least this many significant digits count as measured or computed, not chosen.
pub const DIGITS: usize = 9;

/// Evidence that a mechanism is rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct Rounded {
    /// Number of coordinates that look rounded.
    pub coordinates: usize,
    /// Location of the first of them, such as `axis of joint 2-3`.
    pub place: String,
    /// Its value as text.
    pub value: String,
    /// Whether only digits of π make it look rounded.
    pub pi: bool,
    /// The fewest digits among the coordinates that look measured, [`DIGITS`] or more, or `None` if there are none.
    pub digits: Option<usize>,
}

impl fmt::Display for Rounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the {} has {}", self.place, self.value)?;
        match self.coordinates {
            0 | 1 => Ok(()),
            n => write!(f, ", and {} other coordinates are similar", n - 1),
        }
    }
}

/// Statistics of a mechanism's decimals.
#[derive(Default)]
struct SeenDecimals {
    /// Count, location and value as text of the first coordinate, for those that look measured and for all.
    first: [Option<(usize, String, String)>; 2],
    digits: Option<usize>,
    /// Number of those that look measured and contain π.
    pi: usize,
}

impl SeenDecimals {
    /// Adds a coordinate that is long from `least` significant digits on.
    fn see_number(&mut self, v: &Expr, least: usize, place: &dyn Fn() -> String) {
        let Some(digits) = decimal_digits(v).filter(|d| d.is_none_or(|n| n >= least)) else {
            return;
        };
        let digits = digits.filter(|n| *n >= DIGITS);
        let measured = digits.is_some();
        self.pi += usize::from(measured && v.has_pi());
        self.digits = self.digits.into_iter().chain(digits).min();
        for (first, counts) in self.first.iter_mut().zip([measured, true]) {
            if counts {
                first
                    .get_or_insert_with(|| (0, place(), coordinate_text(v)))
                    .0 += 1;
            }
        }
    }

    /// Adds the coordinates of a vector, or a single one.
    fn see_vector(&mut self, v: &[Expr], kind: NumberKind, place: &dyn Fn() -> String) {
        let least = kind.least_digits_of(v);
        v.iter().for_each(|c| self.see_number(c, least, place));
    }

    fn see_frame(&mut self, f: &Frame, at: &dyn Fn() -> String) {
        let place = |what: &'static str| move || format!("{what} of {}", at());
        self.see_vector(&f.point, NumberKind::Length, &place("point"));
        self.see_vector(&f.axis, NumberKind::Direction, &place("axis"));
        self.see_vector(&f.reference, NumberKind::Direction, &place("reference"));
        let pitch = std::slice::from_ref(&f.pitch);
        self.see_vector(pitch, NumberKind::Length, &place("pitch"));
    }
}

/// Returns the text of a coordinate for reports.
fn coordinate_text(v: &Expr) -> String {
    if v.has_pi() {
        format!("{v}, with {PI_DIGITS} decimals of pi")
    } else {
        format!("{:?}", v.to_f64())
    }
}

/// Returns the evidence if coordinates of the joints, their options, or the plane are decimals long enough to have been
/// rounded.
///
/// A length is long with at least four significant digits, and a direction with three. Two are enough if the direction
/// has length 1 within them and not exactly. Fractions and roots written as such are exact, however long their decimals
/// are, and so are whole numbers.
///
/// # Examples
/// ```
/// use ozols::model::rounded::looks_rounded;
/// assert!(looks_rounded(&ozols::built_in("bennett")?).is_none());
/// assert!(looks_rounded(&ozols::built_in("jansen-leg")?).is_some_and(|r| r.coordinates == 11));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn looks_rounded(mechanism: &Mechanism) -> Option<Rounded> {
    let mut seen = SeenDecimals::default();
    for joint in &mechanism.joints {
        seen.see_frame(&joint.frame, &|| format!("joint {}", joint.id));
        // Options mostly share the joint's position; only their own coordinates count.
        for o in joint.offered_options() {
            let values = |f: &Frame| (f.vectors().map(to_vector), f.pitch.to_f64());
            if values(&o.frame) != values(&joint.frame) {
                seen.see_frame(&o.frame, &|| {
                    format!("option {} of joint {}", o.name, joint.id)
                });
            }
        }
    }
    if let Mode::Planar { normal } = &mechanism.mode {
        let place = || "normal of the plane".to_owned();
        seen.see_vector(normal, NumberKind::Direction, &place);
    }
    let [measured, any] = seen.first;
    let pi = measured.as_ref().is_some_and(|m| m.0 == seen.pi);
    let (coordinates, place, value) = measured.or(any)?;
    Some(Rounded {
        coordinates,
        place,
        value,
        pi,
        digits: seen.digits,
    })
}

/// Returns the number of significant digits of a decimal or a number with decimals of pi, without a number if its
/// accuracy is stated. Returns `None` for all exact numbers.
fn decimal_digits(expr: &Expr) -> Option<Option<usize>> {
    if expr.has_pi() {
        return Some(Some(PI_DIGITS));
    }
    match expr.written() {
        // The `.0` after a whole number has no meaning.
        WrittenNumber::Decimal(d) if d.end != End::Float => Some(Some(d.significant)),
        WrittenNumber::Stated(half) if half > 0.0 => Some(measured_digits(expr)),
        _ => None,
    }
}

/// Returns the number of significant digits of a number as a double, if there are so many that it was measured or
/// computed.
fn measured_digits(expr: &Expr) -> Option<usize> {
    match Expr::from_f64(expr.to_f64()).ok()?.written() {
        WrittenNumber::Decimal(d) => Some(d.significant).filter(|n| *n >= DIGITS),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_have_digits() {
        let of = |s: &str| decimal_digits(&s.parse::<Expr>().unwrap());
        assert_eq!(of("0.8660254037844386"), Some(Some(16)));
        assert_eq!(of("-12.7"), Some(Some(3)));
        assert_eq!(of("0.49400"), Some(Some(5)));
        assert_eq!(of("1e-9"), Some(Some(1)));
        assert_eq!(of("0.000123456789"), Some(Some(9)));
        for exact in [
            "1/3",
            "sqrt(3)/2",
            "1/4096",
            "123456789/10^20",
            "123456789012",
            "80.0",
            "cos(36deg)",
        ] {
            assert_eq!(of(exact), None, "{exact}");
        }
    }
}
