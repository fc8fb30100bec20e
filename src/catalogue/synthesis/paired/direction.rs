//! Directions in the plane whose coordinates and length are whole numbers.

use crate::synthesis::point::Point;

/// Of the first quarter, from along x to nearly along y, evenly about its middle.
const QUARTER: [[i32; 3]; 15] = [
    [1, 0, 1],
    [60, 11, 61],
    [40, 9, 41],
    [35, 12, 37],
    [12, 5, 13],
    [15, 8, 17],
    [4, 3, 5],
    [21, 20, 29],
    [20, 21, 29],
    [3, 4, 5],
    [8, 15, 17],
    [5, 12, 13],
    [12, 35, 37],
    [9, 40, 41],
    [11, 60, 61],
];

/// How many there are.
pub(super) const ALL: usize = 4 * QUARTER.len();

/// A direction whose coordinates and length are whole: the sides of a right triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WholeDirection(usize);

impl WholeDirection {
    /// Along x.
    pub const AHEAD: WholeDirection = WholeDirection(0);
    /// Along y.
    pub const ACROSS: WholeDirection = WholeDirection(QUARTER.len());

    /// The direction of a number: one turn of them.
    #[must_use]
    pub fn number(n: usize) -> WholeDirection {
        WholeDirection(n % ALL)
    }

    /// The next but so many, left round where positive.
    #[must_use]
    pub fn turned(self, by: isize) -> WholeDirection {
        let all = ALL.cast_signed();
        WholeDirection((self.0.cast_signed() + by).rem_euclid(all).cast_unsigned())
    }

    /// Its image across the x axis.
    #[must_use]
    pub fn mirrored(self) -> WholeDirection {
        WholeDirection((ALL - self.0) % ALL)
    }

    /// The opposite one.
    #[must_use]
    pub fn reversed(self) -> WholeDirection {
        WholeDirection((self.0 + ALL / 2) % ALL)
    }

    /// Its coordinates.
    #[must_use]
    pub fn whole(self) -> [i32; 2] {
        let [x, y, _] = QUARTER[self.0 % QUARTER.len()];
        match self.0 / QUARTER.len() {
            0 => [x, y],
            1 => [-y, x],
            2 => [-x, -y],
            _ => [y, -x],
        }
    }

    /// Of length 1, in double precision.
    #[must_use]
    pub fn real(self) -> Point {
        let length = QUARTER[self.0 % QUARTER.len()][2];
        self.whole().map(|x| f64::from(x) / f64::from(length))
    }
}

#[cfg(test)]
mod tests {
    use super::{ALL, WholeDirection};

    #[test]
    fn directions_go_round_once_and_have_whole_lengths() {
        let mut before = -1.0;
        for n in 0..ALL {
            let d = WholeDirection::number(n);
            let [x, y] = d.whole();
            let length = f64::from(x).hypot(f64::from(y));
            assert_eq!(length, length.round());
            let [a, b] = d.real();
            assert!((a.hypot(b) - 1.0).abs() < 1e-15);
            let angle = b.atan2(a).rem_euclid(std::f64::consts::TAU);
            assert!(angle > before, "{n}");
            before = angle;
            assert_eq!(d.mirrored().whole(), [x, -y]);
            assert_eq!(d.reversed().whole(), [-x, -y]);
            assert_eq!(d.turned(-7).turned(7), d);
        }
    }
}
