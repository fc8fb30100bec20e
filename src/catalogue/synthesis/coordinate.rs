//! Numbers and places as a mechanism file writes them, exactly.

use crate::file::schema::Coordinate;
use crate::synthesis::place::{Place, third};

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
fn turned([x, y]: [f64; 2], thirds: u8) -> [Coordinate; 2] {
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
    Pivot::Normal.point(place)
}

/// What thirds of a turn go round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pivot {
    /// The normal of the plane at the origin: all sides are in one plane.
    Normal,
    /// The x axis: each side is in a plane of its own.
    Ahead,
}

impl Pivot {
    /// A vector after so many thirds of a turn, exactly.
    pub(super) fn turned(self, [x, y, z]: [f64; 3], thirds: u8) -> [Coordinate; 3] {
        match self {
            Pivot::Normal => {
                let [x, y] = turned([x, y], thirds);
                [x, y, number(z)]
            }
            Pivot::Ahead => {
                let [y, z] = turned([y, z], thirds);
                [number(x), y, z]
            }
        }
    }

    /// A place, turned as often as it says.
    pub(super) fn point(self, place: Place) -> [Coordinate; 3] {
        let [x, y] = place.unturned();
        self.turned([x, y, 0.0], place.thirds)
    }

    /// The same in double precision.
    pub(super) fn real(self, place: Place) -> [f64; 3] {
        let [x, y] = place.unturned();
        let turned = |p: [f64; 2]| (0..place.thirds).fold(p, |p, _| third(p));
        match self {
            Pivot::Normal => {
                let [x, y] = turned([x, y]);
                [x, y, 0.0]
            }
            Pivot::Ahead => {
                let [y, z] = turned([y, 0.0]);
                [x, y, z]
            }
        }
    }
}
