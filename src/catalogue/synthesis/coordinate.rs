//! Numbers and places as a mechanism file writes them, exactly.

use crate::file::schema::Coordinate;
use crate::synthesis::place::Place;

/// A number, without a point where it is whole.
pub(super) fn number(x: f64) -> Coordinate {
    #[allow(clippy::cast_possible_truncation, reason = "whole and small")]
    if x.fract() == 0.0 && x.abs() < 1e15 {
        Coordinate::Integer(x as i64)
    } else {
        Coordinate::Decimal(x)
    }
}

/// A vector after so many thirds of a turn, exactly.
pub(super) fn turned([x, y]: [f64; 2], thirds: u8) -> [Coordinate; 2] {
    // (a + b √3) / 2.
    let surd = |a: f64, b: f64| {
        let sign = if b < 0.0 { '-' } else { '+' };
        match (a, b) {
            (_, 0.0) => number(a / 2.0),
            (0.0, _) => Coordinate::Expression(format!("{b}*sqrt(3)/2")),
            _ => Coordinate::Expression(format!("({a} {sign} {}*sqrt(3))/2", b.abs())),
        }
    };
    match thirds {
        0 => [number(x), number(y)],
        1 => [surd(-x, -y), surd(-y, x)],
        _ => [surd(-x, y), surd(-y, -x)],
    }
}

pub(super) fn point(place: Place) -> [Coordinate; 3] {
    let [x, y] = turned(place.unturned(), place.thirds);
    [x, y, Coordinate::Integer(0)]
}
