//! Detection of coordinates that were rounded, measured or computed in floating point, by their digits, and the unit of
//! their rounding.
//!
//! Exact ranks take every digit as written. So an axis that is parallel to another except for the last digit counts as
//! tilted, and constraints that are actually redundant count as independent.

mod class;
pub mod ratio;
mod source;
mod uncertainty;

pub use class::{LONG_DIRECTION, LONG_LENGTH};
pub use source::{Largest, Sources};
pub use uncertainty::{FrameNumbers, FrameUncertainty, Uncertainties, uncertainties};

use crate::geom::expr::{End, Expr, PI_DIGITS, WrittenNumber};
use crate::geom::vector::{length, to_vector};
use crate::model::mechanism::{Frame, Mechanism, Mode};
use class::is_rounded;
use std::collections::BTreeMap;
use std::fmt;

/// Decimals with at least this many significant digits count as measured or computed, not chosen.
pub const DIGITS: usize = 9;
/// Minimum share of those decimals, one in this many, with the unit or a coarser one. One last digit in ten happens to
/// be 0.
const SHARE: usize = 5;

/// One unit in the last place of coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Unit of points and pitches, in the file's unit of length; 0 if they are exact.
    pub length: f64,
    /// Unit of the components of directions of unit length; 0 if they are exact.
    pub direction: f64,
}

/// Evidence that a mechanism is rounded, and the unit of rounding.
#[derive(Debug, Clone, PartialEq)]
pub struct Rounded {
    /// Number of coordinates that look rounded.
    pub coordinates: usize,
    /// Location of the first of them, such as `axis of joint 2-3`.
    pub place: String,
    /// Its value as text.
    pub value: String,
    /// The unit in their last place.
    pub units: Units,
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

/// Kind of a coordinate: a length, or a component of a direction.
#[derive(Clone, Copy)]
struct CoordinateKind {
    /// The length of the direction; 0 for a length.
    norm: f64,
    /// Number of digits from which on it counts as long.
    least: usize,
}

impl CoordinateKind {
    /// The kind of points and pitches.
    const LENGTH: CoordinateKind = CoordinateKind {
        norm: 0.0,
        least: LONG_LENGTH,
    };

    /// Returns the kind of the components of a direction.
    fn of_direction(direction: &[Expr; 3]) -> CoordinateKind {
        let least = if is_rounded(direction) {
            1
        } else {
            LONG_DIRECTION
        };
        CoordinateKind {
            norm: length(to_vector(direction)),
            least,
        }
    }
}

/// Statistics of a mechanism's decimals.
#[derive(Default)]
struct SeenDecimals {
    /// Units of long lengths, and of long components of directions, by their size.
    units: [BTreeMap<u64, f64>; 2],
    /// Count, location and value as text of the first coordinate, for those that look measured and for all.
    first: [Option<(usize, String, String)>; 2],
    digits: Option<usize>,
    /// Number of those that look measured and contain π.
    pi: usize,
}

impl SeenDecimals {
    /// Adds a coordinate.
    fn see_number(&mut self, v: &Expr, kind: CoordinateKind, place: &dyn Fn() -> String) {
        let direction = kind.norm > 0.0;
        let long = |d: &Decimal| d.digits.is_none_or(|n| n >= kind.least);
        let Some(decimal) = decimal_of(v).filter(long) else {
            return;
        };
        let of = if direction { kind.norm } else { 1.0 };
        // A value used at several joints is one number.
        let size = v.to_f64().abs().to_bits();
        self.units[usize::from(direction)].insert(size, decimal.unit / of);
        let digits = decimal.digits.filter(|n| *n >= DIGITS);
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

    fn see_frame(&mut self, f: &Frame, at: &dyn Fn() -> String) {
        for (what, vector, direction) in [
            ("point", &f.point, false),
            ("axis", &f.axis, true),
            ("reference", &f.reference, true),
        ] {
            let kind = if direction {
                CoordinateKind::of_direction(vector)
            } else {
                CoordinateKind::LENGTH
            };
            for c in vector {
                self.see_number(c, kind, &|| format!("{what} of {}", at()));
            }
        }
        self.see_number(&f.pitch, CoordinateKind::LENGTH, &|| {
            format!("pitch of {}", at())
        });
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

/// Returns the coarsest unit that enough decimals share; 0 for none.
fn shared_unit(mut units: Vec<f64>) -> f64 {
    units.sort_by(|a, b| b.total_cmp(a));
    let enough = units.len().div_ceil(SHARE);
    enough.checked_sub(1).map_or(0.0, |i| units[i])
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
            let own = |a: &[Expr; 3], b: &[Expr; 3]| to_vector(a) != to_vector(b);
            if own(&o.frame.point, &joint.frame.point)
                || own(&o.frame.axis, &joint.frame.axis)
                || own(&o.frame.reference, &joint.frame.reference)
                || o.frame.pitch.to_f64() != joint.frame.pitch.to_f64()
            {
                seen.see_frame(&o.frame, &|| {
                    format!("option {} of joint {}", o.name, joint.id)
                });
            }
        }
    }
    if let Mode::Planar { normal } = &mechanism.mode {
        let kind = CoordinateKind::of_direction(normal);
        for c in normal {
            seen.see_number(c, kind, &|| "normal of the plane".to_owned());
        }
    }
    let [measured, any] = seen.first;
    let pi = measured.as_ref().is_some_and(|m| m.0 == seen.pi);
    let (coordinates, place, value) = measured.or(any)?;
    let [lengths, directions] = seen.units;
    Some(Rounded {
        coordinates,
        place,
        value,
        units: Units {
            length: shared_unit(lengths.into_values().collect()),
            direction: shared_unit(directions.into_values().collect()),
        },
        pi,
        digits: seen.digits,
    })
}

/// Accuracy of a number according to its digits.
struct Decimal {
    /// Significant digits, or `None` if the accuracy of the number is stated.
    digits: Option<usize>,
    /// One unit in the last place.
    unit: f64,
}

/// Returns the accuracy of a decimal, of a number with decimals of pi, or of one with a stated uncertainty. Returns
/// `None` for all exact numbers.
fn decimal_of(expr: &Expr) -> Option<Decimal> {
    if expr.has_pi() {
        let places = i32::try_from(PI_DIGITS).unwrap_or(i32::MAX);
        return Some(Decimal {
            digits: Some(PI_DIGITS),
            unit: 10f64.powi(-places),
        });
    }
    match expr.written() {
        // The `.0` after a whole number has no meaning.
        WrittenNumber::Decimal(d) if d.end != End::Float => Some(Decimal {
            digits: Some(d.significant),
            unit: 2.0 * d.half,
        }),
        WrittenNumber::Stated(half) if half > 0.0 => Some(Decimal {
            digits: measured_digits(expr),
            unit: 2.0 * half,
        }),
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
    fn decimals_have_digits_and_a_unit() {
        let of =
            |s: &str| decimal_of(&s.parse::<Expr>().unwrap()).map(|d| (d.digits.unwrap(), d.unit));
        assert_eq!(of("0.8660254037844386"), Some((16, 1e-16)));
        assert_eq!(of("-12.7"), Some((3, 0.1)));
        assert_eq!(of("0.49400"), Some((5, 1e-5)));
        assert_eq!(of("1e-9"), Some((1, 1e-9)));
        assert_eq!(of("0.000123456789"), Some((9, 1e-12)));
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

    #[test]
    fn the_unit_is_the_coarsest_that_a_fifth_shares() {
        assert_eq!(shared_unit(vec![]), 0.0);
        // One last digit in ten is 0.
        let mut units = vec![1e-6; 9];
        units.push(1e-5);
        assert_eq!(shared_unit(units.clone()), 1e-6);
        units.extend([1e-5, 1e-4]);
        assert_eq!(shared_unit(units), 1e-5);
    }
}
