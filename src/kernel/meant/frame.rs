//! The scene's own frame, in which its planes are coordinate planes. This is the file's frame if a direction of the
//! scene is one of the file's axes. Otherwise it is rotated by a rational rotation, so that exact values in one frame
//! are exact in the other.

use super::directions::Direction;
use super::number::{Rational3, Whole, nearest_decimal, to_f64};
use crate::geom::vector::{Vector, X, Y, Z, across, cross, dot, length, unit};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// Digits of the numbers that define a rotation: the full precision of doubles.
const DIGITS: u32 = 18;

/// An exact rotation from the scene's frame to the file's.
#[derive(Debug, Clone)]
pub(super) struct SceneFrame {
    /// The rotation by rows, or `None` if the frames are equal.
    pub(super) rotation: Option<[Rational3; 3]>,
    /// The rotation and its inverse as whole numbers.
    whole: Option<[Whole<3>; 2]>,
    real: [Vector; 3],
}

impl SceneFrame {
    /// Creates the file's own frame.
    fn of_file() -> SceneFrame {
        SceneFrame {
            rotation: None,
            whole: None,
            real: [X, Y, Z],
        }
    }

    /// Returns true if a direction is one of the file's axes, or written exactly. Then the file's frame is the scene's.
    pub(super) fn is_the_files(all: &[Direction]) -> bool {
        let is_axis = |d: &Direction| [X, Y, Z].iter().any(|e| length(cross(*e, d.unit)) == 0.0);
        all.iter()
            .any(|d| d.rays > 0 && (d.exact.is_some() || is_axis(d)))
    }

    /// Creates the frame of some directions. z is the most accurate one, and x the most accurate one perpendicular to
    /// it or in a plane with it.
    pub(super) fn from_directions(all: &[Direction]) -> SceneFrame {
        if SceneFrame::is_the_files(all) {
            return SceneFrame::of_file();
        }
        let used = || all.iter().filter(|d| d.rays > 0);
        let sharper =
            |a: &&Direction, b: &&Direction| a.error.total_cmp(&b.error).then(b.rays.cmp(&a.rays));
        let Some(first) = used().min_by(sharper).or(all.first()) else {
            return SceneFrame::of_file();
        };
        let z = first.unit;
        let square = |d: &&Direction| dot(d.unit, z).abs() <= 1e-12;
        let other = |d: &&Direction| length(cross(d.unit, z)) > 0.1;
        let axis = [X, Y, Z].into_iter().find(|e| dot(*e, z).abs() <= 1e-12);
        let frequent = all.iter().filter(square).min_by(sharper).map(|d| d.unit);
        let frequent = frequent.or(used().filter(other).min_by(sharper).map(|d| d.unit));
        let any = if z[0].abs() < 0.9 { X } else { Y };
        let x = unit(across(axis.or(frequent).unwrap_or(any), z));
        if [x, z].iter().flatten().all(|c| c.is_finite()) {
            SceneFrame::from_axes([x, cross(z, x), z])
        } else {
            SceneFrame::of_file()
        }
    }

    /// Returns the rational rotation nearest to the one whose columns are these axes.
    fn from_axes(columns: [Vector; 3]) -> SceneFrame {
        let m = |i: usize, j: usize| columns[j][i];
        let trace = [1.0, m(0, 0), m(1, 1), m(2, 2)];
        // There are four formulas for the quaternion; the one by its largest component is accurate.
        let squares = [
            trace[0] + trace[1] + trace[2] + trace[3],
            trace[0] + trace[1] - trace[2] - trace[3],
            trace[0] - trace[1] + trace[2] - trace[3],
            trace[0] - trace[1] - trace[2] + trace[3],
        ];
        let most = (0..4)
            .max_by(|&a, &b| squares[a].total_cmp(&squares[b]))
            .unwrap_or(0);
        let s = squares[most].sqrt();
        let (d, sum) = (
            |i: usize, j: usize| m(i, j) - m(j, i),
            |i: usize, j: usize| m(i, j) + m(j, i),
        );
        let q = match most {
            0 => [s, d(2, 1) / s, d(0, 2) / s, d(1, 0) / s],
            1 => [d(2, 1) / s, s, sum(0, 1) / s, sum(0, 2) / s],
            2 => [d(0, 2) / s, sum(0, 1) / s, s, sum(1, 2) / s],
            _ => [d(1, 0) / s, sum(0, 2) / s, sum(1, 2) / s, s],
        };
        let [w, x, y, z] = q.map(|c| {
            if c.abs() < 1e-15 {
                BigRational::zero()
            } else {
                nearest_decimal(c / 2.0, DIGITS)
            }
        });
        let norm = [&w, &x, &y, &z]
            .iter()
            .fold(BigRational::zero(), |n, c| n + *c * *c);
        let two = BigRational::from_integer(BigInt::from(2)) / norm;
        let diagonal =
            |a: &BigRational, b: &BigRational| BigRational::one() - &two * (a * a + b * b);
        let off = |a: &BigRational, b: &BigRational, sign: i32, c: &BigRational| {
            let last = &w * c;
            &two * (a * b + if sign > 0 { last } else { -last })
        };
        let rotation = [
            [diagonal(&y, &z), off(&x, &y, -1, &z), off(&x, &z, 1, &y)],
            [off(&x, &y, 1, &z), diagonal(&x, &z), off(&y, &z, -1, &x)],
            [off(&x, &z, -1, &y), off(&y, &z, 1, &x), diagonal(&x, &y)],
        ];
        let real = rotation.each_ref().map(to_f64);
        let out = Whole::over_denominator(rotation.each_ref());
        SceneFrame {
            whole: Some([out.clone(), out.transpose()]),
            rotation: Some(rotation),
            real,
        }
    }

    /// Converts a vector of the file to the scene's frame.
    pub(super) fn scene_vector(&self, v: Vector) -> Vector {
        [0, 1, 2].map(|j| (0..3).map(|i| self.real[i][j] * v[i]).sum())
    }

    /// Converts a vector of the scene's frame to the file's.
    pub(super) fn file_vector(&self, v: Vector) -> Vector {
        self.real.map(|row| dot(row, v))
    }

    /// Converts an exact vector of the file to the scene's frame.
    pub(super) fn inside_exactly(&self, v: &Rational3) -> Rational3 {
        match &self.whole {
            None => v.clone(),
            Some([_, inwards]) => inwards.times(v),
        }
    }

    /// Converts an exact vector of the scene's frame to the file's.
    pub(super) fn outside_exactly(&self, v: &Rational3) -> Rational3 {
        match &self.whole {
            None => v.clone(),
            Some([outwards, _]) => outwards.times(v),
        }
    }
}
