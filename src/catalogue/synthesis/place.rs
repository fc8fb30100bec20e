//! Exact places: whole millimetres, with or without thousandths, or whole millimetres turned by thirds of a turn, whose coordinates contain
//! √3. Also points of the plane in double precision, and their form in a mechanism file.

pub mod direction;

use crate::file::schema::Coordinate;
use crate::geom::vector::add_scaled;

/// Thousandths of a millimetre in a millimetre.
pub(super) const FINE: i32 = 1000;

/// A place in the plane.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Place {
    /// Whole millimetres.
    pub whole: [i32; 2],
    /// Additional thousandths of a millimetre; 0 if the place is turned.
    pub fine: [i32; 2],
    /// Number of turns by 120° about the origin: 0, 1 or 2.
    pub thirds: u8,
}

impl From<[i32; 2]> for Place {
    fn from(whole: [i32; 2]) -> Place {
        Place {
            whole,
            ..Place::default()
        }
    }
}

impl Place {
    /// Returns the place of a point, rounded to thousandths of a millimetre.
    #[must_use]
    pub(super) fn of_point(point: Point) -> Place {
        #[allow(clippy::cast_possible_truncation, reason = "some metres")]
        let thousandths = point.map(|x| (x * f64::from(FINE)).round() as i64);
        let part = |whole: i64| i32::try_from(whole).unwrap_or(i32::MAX);
        let (fine, half) = (i64::from(FINE), i64::from(FINE / 2));
        // The nearest whole millimetre.
        let whole = |x: i64| (x + half).div_euclid(fine);
        Place {
            whole: thousandths.map(|x| part(whole(x))),
            fine: thousandths.map(|x| part(x - fine * whole(x))),
            thirds: 0,
        }
    }

    /// Returns its coordinates before the turn, as the doubles nearest to the decimals.
    fn unturned(self) -> [f64; 2] {
        let thousandths =
            |k: usize| f64::from(self.whole[k]) * f64::from(FINE) + f64::from(self.fine[k]);
        [0, 1].map(|k| thousandths(k) / f64::from(FINE))
    }

    /// Returns the place in double precision.
    ///
    /// # Examples
    /// ```
    /// use ozols::synthesis::place::Place;
    /// let place = Place { whole: [12, 5], fine: [500, 0], thirds: 0 };
    /// assert_eq!(place.real(), [12.5, 5.0]); // mm
    /// ```
    #[must_use]
    pub fn real(self) -> [f64; 2] {
        (0..self.thirds).fold(self.unturned(), |p, _| third(p))
    }
}

/// Returns a point turned by 120° about the origin.
#[must_use]
pub(crate) fn third([x, y]: [f64; 2]) -> [f64; 2] {
    let half_root = 3.0_f64.sqrt() / 2.0;
    [-0.5 * x - half_root * y, half_root * x - 0.5 * y]
}

/// A point of the plane, in millimetres.
pub type Point = [f64; 2];

/// Returns the mean of points.
#[must_use]
pub(crate) fn middle_of<const N: usize>(points: &[[f64; N]]) -> [f64; N] {
    #[allow(clippy::cast_precision_loss, reason = "a few")]
    let n = points.len().max(1) as f64;
    points
        .iter()
        .fold([0.0; N], |m, p| add_scaled(m, 1.0 / n, *p))
}

/// Returns a number as a coordinate, as an integer if it is whole.
pub(super) fn number_words(x: f64) -> Coordinate {
    #[allow(clippy::cast_possible_truncation, reason = "whole and small")]
    if x.fract() == 0.0 && x.abs() < 1e15 {
        Coordinate::Integer(x as i64)
    } else {
        Coordinate::Decimal(x)
    }
}

/// Returns a vector turned by thirds of a turn, exactly.
fn turned([x, y]: [f64; 2], thirds: u8) -> [Coordinate; 2] {
    // (a + b √3) / 2.
    let surd = |a: f64, b: f64| {
        let sign = if b < 0.0 { '-' } else { '+' };
        match (a, b) {
            (_, 0.0) => number_words(a / 2.0),
            (0.0, _) => Coordinate::Expression(format!("{b}*sqrt(3)/2")),
            _ => Coordinate::Expression(format!("({a} {sign} {}*sqrt(3))/2", b.abs())),
        }
    };
    match thirds {
        0 => [number_words(x), number_words(y)],
        1 => [surd(-x, -y), surd(-y, x)],
        _ => [surd(-x, y), surd(-y, -x)],
    }
}

pub(super) fn point(place: Place) -> [Coordinate; 3] {
    Pivot::Normal.point(place)
}

/// Axis of the turns by thirds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pivot {
    /// The normal of the plane at the origin: all sides are in one plane.
    Normal,
    /// The x axis: each side is in a separate plane.
    Ahead,
}

impl Pivot {
    /// Returns a vector turned by thirds of a turn, exactly.
    pub(super) fn turned(self, [x, y, z]: [f64; 3], thirds: u8) -> [Coordinate; 3] {
        match self {
            Pivot::Normal => {
                let [x, y] = turned([x, y], thirds);
                [x, y, number_words(z)]
            }
            Pivot::Ahead => {
                let [y, z] = turned([y, z], thirds);
                [number_words(x), y, z]
            }
        }
    }

    /// Returns a place with its turn, exactly.
    pub(super) fn point(self, place: Place) -> [Coordinate; 3] {
        let [x, y] = place.unturned();
        self.turned([x, y, 0.0], place.thirds)
    }

    /// Returns a place with its turn, in double precision.
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
