//! Numbers of the geometry, written as they were read, with their stated accuracy.

use crate::file::prelude::*;
use crate::geom::expr::{End, WrittenNumber, half_of};
use crate::model::rounded::ratio::doubt_ratio;
use crate::model::rounded::{LONG_DIRECTION, LONG_LENGTH};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Writes a number as a decimal if it has at most 17 digits, otherwise as an expression. An exact fraction whose decimal would
/// look rounded, and a decimal with trailing zeros, which numbers lose, are also expressions.
pub(super) fn write_coordinate(e: &Expr) -> Coordinate {
    write_expression(e, &|d| is_long(d, LONG_LENGTH))
}

/// Writes a component of a direction in the same way.
pub(super) fn write_component(e: &Expr) -> Coordinate {
    write_expression(e, &|d| is_long(d, LONG_DIRECTION))
}

/// Writes the ratio of a coupling in the same way.
pub(super) fn write_ratio(e: &Expr) -> Coordinate {
    write_expression(e, &|d| doubt_ratio(d).is_some())
}

fn is_long(decimal: &Expr, least: usize) -> bool {
    matches!(decimal.written(), WrittenNumber::Decimal(d) if d.significant >= least)
}

/// Writes a number; an exact fraction is written as a fraction if its decimal is `doubtful`.
fn write_expression(e: &Expr, doubtful: &dyn Fn(&Expr) -> bool) -> Coordinate {
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
        && with_zeros(&value, written).is_none()
    {
        return Coordinate::Integer(whole);
    }
    if let Some(text) = with_zeros(&value, written) {
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

/// Returns true if the number is 0, 1 or -1.
fn is_chosen(value: &BigRational) -> bool {
    value.is_zero() || value.abs().is_one()
}

/// Returns a decimal whose last digit is 0, with all its digits.
fn with_zeros(value: &BigRational, written: WrittenNumber) -> Option<String> {
    let WrittenNumber::Decimal(digits) = written else {
        return None;
    };
    if digits.end != End::Zero {
        return None;
    }
    let places = digits.places;
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

/// Writes a number in its usual form.
pub(crate) fn plain_number(x: f64) -> Coordinate {
    #[allow(clippy::cast_possible_truncation, reason = "whole and within 2^53")]
    if x.fract() == 0.0 && x.abs() < 2f64.powi(53) {
        return Coordinate::Integer(x as i64);
    }
    Coordinate::Decimal(x)
}

/// Returns the tolerance of most numbers of the points, and of all of the directions.
pub(super) fn file_tolerance(m: &Mechanism) -> Option<ToleranceEntry> {
    let frames = m.joints.iter().map(|j| &j.frame);
    let points = frames.clone().flat_map(|f| &f.point);
    let points = points.chain(m.points.iter().flat_map(|p| &p.point));
    let directions = frames.flat_map(|f| [&f.axis, &f.reference]);
    let directions = directions.flat_map(|v| v.iter().map(move |e| (length(to_vector(v)), e)));
    let lengths = most_common_half(
        points
            .filter(|e| e.to_f64() != 0.0)
            .map(|e| (e, stated_half(e))),
    );
    let turned = directions.filter(|(_, e)| ![0.0, 1.0].contains(&e.to_f64().abs()));
    let direction = most_common_half(
        turned.map(|(of, e)| (e, stated_half(e).map(|half| round_digits(half / of)))),
    );
    let entry = |x: Option<f64>| x.map(plain_number);
    (lengths.is_some() || direction.is_some()).then(|| ToleranceEntry {
        length: entry(lengths),
        direction: entry(direction),
    })
}

/// Returns the tolerance of a single point, if it differs from that of the file.
pub(super) fn point_tolerance(
    point: &[Expr; 3],
    file: Option<&ToleranceEntry>,
) -> Option<Coordinate> {
    let halves = point.iter().filter_map(stated_half);
    let half = plain_number(halves.reduce(f64::max)?);
    let of_file = file.and_then(|t| t.length.as_ref());
    (of_file != Some(&half)).then_some(half)
}

/// Removes errors in the last bits of a value that was multiplied by a length and divided again.
fn round_digits(x: f64) -> f64 {
    format!("{x:.12e}").parse().unwrap_or(x)
}

fn stated_half(e: &Expr) -> Option<f64> {
    match e.written() {
        WrittenNumber::Stated(half) => Some(half),
        _ => None,
    }
}

/// Returns the most common half unit. `None` if a value that would be read as a number has none.
fn most_common_half<'e>(of: impl Iterator<Item = (&'e Expr, Option<f64>)>) -> Option<f64> {
    let mut count: Vec<(f64, usize)> = Vec::new();
    for (e, half) in of {
        match half {
            None if e.written() == WrittenNumber::No => {}
            None => return None,
            Some(half) => match count.iter_mut().find(|c| c.0.to_bits() == half.to_bits()) {
                Some(c) => c.1 += 1,
                None => count.push((half, 1)),
            },
        }
    }
    let most = count.iter().map(|c| c.1).max();
    count.iter().find(|c| Some(c.1) == most).map(|c| c.0)
}
