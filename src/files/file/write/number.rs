//! Numbers of the geometry, such that they say what they said where they were read.

use crate::file::schema::Coordinate;
use crate::geom::expr::{Digits, End, Expr, WrittenNumber, half_of};
use crate::model::rounded::ratio::doubt;
use crate::model::rounded::{LONG_DIRECTION, LONG_LENGTH};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// A number where it is a decimal of at most 17 digits, else an expression. So is an exact fraction that as a decimal would
/// look rounded, and a decimal with zeros at its end, which numbers lose.
pub(super) fn coordinate(e: &Expr) -> Coordinate {
    written(e, &|d| is_long(d, LONG_LENGTH))
}

/// The same of a component of a direction.
pub(super) fn component(e: &Expr) -> Coordinate {
    written(e, &|d| is_long(d, LONG_DIRECTION))
}

/// The same of the ratio of a coupling.
pub(super) fn ratio(e: &Expr) -> Coordinate {
    written(e, &|d| doubt(d).is_some())
}

fn is_long(decimal: &Expr, least: usize) -> bool {
    matches!(decimal.written(), WrittenNumber::Decimal(d) if d.significant >= least)
}

/// A number; a fraction that is exact is one where its decimal is `doubtful`.
fn written(e: &Expr, doubtful: &dyn Fn(&Expr) -> bool) -> Coordinate {
    let Some(value) = e.as_rational() else {
        return Coordinate::Expression(e.to_string());
    };
    let written = e.written();
    if matches!(written, WrittenNumber::Stated(half) if half > 0.0) && is_chosen(&value) {
        // As whole numbers they would be exact.
        return Coordinate::Expression(format!("{value}.00"));
    }
    if value.is_integer()
        && let Ok(whole) = i64::try_from(value.numer())
        && zeros(&value, written).is_none()
    {
        return Coordinate::Integer(whole);
    }
    if let Some(text) = zeros(&value, written) {
        return Coordinate::Expression(text);
    }
    let near = e.to_f64();
    let Ok(read) = Expr::from_f64(near) else {
        return Coordinate::Expression(e.to_string());
    };
    let exact = matches!(written, WrittenNumber::No) || written == WrittenNumber::Stated(0.0);
    if exact && doubtful(&read) {
        return Coordinate::Expression(format!("{}/{}", value.numer(), value.denom()));
    }
    if read.as_rational().as_ref() == Some(&value) {
        Coordinate::Decimal(near)
    } else {
        Coordinate::Expression(e.to_string())
    }
}

/// Whether it is 0 or 1 in size.
fn is_chosen(value: &BigRational) -> bool {
    value.is_zero() || value.abs().is_one()
}

/// A decimal whose last digit is 0, with all its digits.
fn zeros(value: &BigRational, written: WrittenNumber) -> Option<String> {
    let WrittenNumber::Decimal(
        digits @ Digits {
            places,
            end: End::Zero,
            ..
        },
    ) = written
    else {
        return None;
    };
    let width = usize::try_from(places)
        .ok()
        .filter(|p| (1..=100).contains(p))?;
    if digits.half.to_bits() != half_of(places).to_bits() {
        return None;
    }
    let scaled = value.abs() * BigRational::from_integer(BigInt::from(10).pow(places.to_u32()?));
    let all = format!("{:0>1$}", scaled.to_integer(), width + 1);
    let (whole, fraction) = all.split_at(all.len() - width);
    let sign = if value.is_negative() { "-" } else { "" };
    Some(format!("{sign}{whole}.{fraction}"))
}
