//! Directions in the plane whose coordinates and length are whole numbers.

use crate::synthesis::place::{Place, Point, third};

/// Directions of the first quadrant, from along x to nearly along y, symmetric about its middle.
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

/// Number of directions in one turn.
pub(in crate::synthesis) const ALL: usize = 4 * QUARTER.len();

/// Direction whose coordinates and length are whole: the sides of a right triangle. It may be turned by thirds of a turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WholeDirection {
    /// Its number among the directions of one turn.
    number: usize,
    /// Number of turns by 120°: 0, 1 or 2.
    thirds: u8,
}

impl WholeDirection {
    /// Along x.
    pub const AHEAD: WholeDirection = WholeDirection::of(0, 0);
    /// Along y.
    pub const ACROSS: WholeDirection = WholeDirection::of(QUARTER.len(), 0);

    const fn of(number: usize, thirds: u8) -> WholeDirection {
        WholeDirection { number, thirds }
    }

    /// Returns the direction of this number, modulo one turn.
    #[must_use]
    pub fn number(n: usize) -> WholeDirection {
        WholeDirection::of(n % ALL, 0)
    }

    /// Returns the direction turned counterclockwise by this many thirds of a turn.
    #[must_use]
    pub(in crate::synthesis) fn turned_by_thirds(self, by: u8) -> WholeDirection {
        WholeDirection::of(self.number, (self.thirds + by) % 3)
    }

    /// Returns the direction this many steps on, counterclockwise if positive.
    #[must_use]
    pub fn turn_by(self, by: isize) -> WholeDirection {
        let all = ALL.cast_signed();
        let number = (self.number.cast_signed() + by).rem_euclid(all);
        WholeDirection::of(number.cast_unsigned(), self.thirds)
    }

    /// Returns its mirror image in the x axis.
    #[must_use]
    pub fn mirror_x(self) -> WholeDirection {
        WholeDirection::of((ALL - self.number) % ALL, (3 - self.thirds) % 3)
    }

    /// Returns the opposite direction.
    #[must_use]
    pub fn reverse_direction(self) -> WholeDirection {
        WholeDirection::of((self.number + ALL / 2) % ALL, self.thirds)
    }

    /// Returns its coordinates before the turn by thirds.
    fn whole_coordinates(self) -> [i32; 2] {
        let [x, y, _] = QUARTER[self.number % QUARTER.len()];
        match self.number / QUARTER.len() {
            0 => [x, y],
            1 => [-y, x],
            2 => [-x, -y],
            _ => [y, -x],
        }
    }

    /// Returns the exact place in this direction from the origin.
    #[must_use]
    pub(crate) fn place_along(self) -> Place {
        Place {
            whole: self.whole_coordinates(),
            thirds: self.thirds,
            ..Place::default()
        }
    }

    /// Returns the vector of length 1, in double precision.
    ///
    /// # Examples
    /// ```
    /// use ozols::synthesis::place::direction::WholeDirection;
    /// assert_eq!(WholeDirection::AHEAD.real(), [1.0, 0.0]);
    /// assert_eq!(WholeDirection::ACROSS.reverse_direction().real(), [0.0, -1.0]);
    /// ```
    #[must_use]
    pub fn real(self) -> Point {
        let length = QUARTER[self.number % QUARTER.len()][2];
        let along = self
            .whole_coordinates()
            .map(|x| f64::from(x) / f64::from(length));
        (0..self.thirds).fold(along, |p, _| third(p))
    }
}

#[cfg(test)]
mod tests {
    use super::{ALL, WholeDirection};
    use std::f64::consts::TAU;

    #[test]
    fn directions_go_round_once_and_have_whole_lengths() {
        let mut before = -1.0;
        for n in 0..ALL {
            let d = WholeDirection::number(n);
            let [x, y] = d.whole_coordinates();
            let length = f64::from(x).hypot(f64::from(y));
            assert_eq!(length, length.round());
            let [a, b] = d.real();
            assert!((a.hypot(b) - 1.0).abs() < 1e-15);
            let angle = b.atan2(a).rem_euclid(TAU);
            assert!(angle > before, "{n}");
            before = angle;
            assert_eq!(d.mirror_x().whole_coordinates(), [x, -y]);
            assert_eq!(d.reverse_direction().whole_coordinates(), [-x, -y]);
            assert_eq!(d.turn_by(-7).turn_by(7), d);
            let on = d.turned_by_thirds(2);
            assert_eq!(on.turned_by_thirds(1), d);
            assert_eq!(on.mirror_x(), d.mirror_x().turned_by_thirds(1));
            let turn = (on.real()[1].atan2(on.real()[0]) - angle).rem_euclid(TAU);
            assert!((turn - 2.0 * TAU / 3.0).abs() < 1e-12);
            assert_eq!(on.place_along().thirds, 2);
        }
    }
}
