//! The geometry as written: points and directions, each number with half a unit of its last digit.

use super::number::Rational3;
use crate::geom::extent::box_diagonal;
use crate::geom::vector::{Vector, dot, length, sub, unit};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// A point, or a direction of any length, as written. The sign of a direction has no meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Its coordinates.
    pub value: Vector,
    /// Its exact coordinates.
    pub exact: Rational3,
    /// Half a unit of the last digit of each; 0 if it is exact.
    pub half: Vector,
}

/// Points and directions of a scene that are images of each other or of themselves, as stated in a file.
#[derive(Debug, Clone)]
pub struct WrittenSymmetry {
    /// Whether the map is half a turn and not a mirror.
    pub turned: bool,
    /// Pairs of points; a point that is its own image is paired with itself.
    pub points: Vec<[usize; 2]>,
    /// Pairs of rays; a ray that is its own image is paired with itself.
    pub rays: Vec<[usize; 2]>,
}

/// The geometry of a file as written.
#[derive(Debug, Clone, Default)]
pub struct WrittenScene {
    /// Its points.
    pub points: Vec<Written>,
    /// Its directions.
    pub rays: Vec<Written>,
    /// The stated symmetry.
    pub symmetry: Option<WrittenSymmetry>,
}

/// Relative accuracy limit: ten times the error of double precision.
const DOUBLE: f64 = 2e-15;

impl WrittenScene {
    /// Returns the largest distance between two points, or 1 if all points coincide.
    pub(super) fn scene_size(&self) -> f64 {
        let size = box_diagonal(self.points.iter().map(|p| p.value));
        if size.is_finite() && size > 0.0 {
            size
        } else {
            1.0
        }
    }

    /// Returns the scene with lengths multiplied by a power of ten, or `None` if the result is too large or small for
    /// doubles.
    pub(super) fn scale_by_power(&self, power: i32) -> Option<WrittenScene> {
        let (by, exactly) = (
            10f64.powi(power),
            BigRational::from_integer(BigInt::from(10)).pow(power),
        );
        let mut out = self.clone();
        for p in &mut out.points {
            for k in 0..3 {
                p.exact[k] *= &exactly;
                p.value[k] = p.exact[k].to_f64()?;
                p.half[k] *= by;
            }
        }
        let finite = out.points.iter().all(|p| {
            let all = p.value.iter().chain(&p.half);
            all.copied().all(f64::is_finite)
        });
        (finite && by.is_finite()).then_some(out)
    }

    /// Returns the largest absolute coordinate, to which double precision is relative.
    fn largest_coordinate(&self) -> f64 {
        let all = self.points.iter().flat_map(|p| p.value);
        all.fold(0.0, |a: f64, x| a.max(x.abs()))
    }

    /// Returns the minimum error of a coordinate: that of double precision.
    pub(super) fn least_error(&self) -> f64 {
        DOUBLE * self.largest_coordinate().max(self.scene_size())
    }

    /// Returns the possible error of each point, in each coordinate.
    pub(super) fn point_errors(&self) -> Vec<f64> {
        let least = self.least_error();
        let largest = |p: &Written| p.half.iter().fold(least, |a, &h| a.max(h));
        self.points.iter().map(largest).collect()
    }
}

impl Written {
    /// Returns the unit vector of a direction.
    pub(super) fn unit_vector(&self) -> Vector {
        unit(self.value)
    }

    /// Returns the possible angular error of a direction `[rad]`; 0 if it is exact.
    pub(super) fn angular_error(&self) -> f64 {
        if self.is_exact() {
            return 0.0;
        }
        (length(self.half) / length(self.value)).max(DOUBLE)
    }

    /// Returns how far its components would move to have a direction, in halves of their last digits or in the minimum
    /// error.
    pub(super) fn move_to(&self, v: Vector, least: f64) -> f64 {
        let least = least.max(DOUBLE * length(self.value));
        let at = |along: f64| {
            (0..3)
                .map(|k| (along * v[k] - self.value[k]).abs() / self.half[k].max(least))
                .fold(0.0, f64::max)
        };
        // An exact component determines the length of the direction, if there is one.
        let exact = (0..3).filter(|&k| self.half[k] == 0.0 && self.value[k] != 0.0 && v[k] != 0.0);
        exact
            .map(|k| at(self.value[k] / v[k]))
            .fold(at(dot(v, self.value) / dot(v, v)), f64::min)
    }

    /// Returns true if every component is exact.
    pub(super) fn is_exact(&self) -> bool {
        self.half == [0.0; 3]
    }
}

/// The difference of two points, and the possible error of its components.
pub(super) struct PointPair {
    pub(super) ends: [usize; 2],
    pub(super) along: Vector,
    pub(super) length: f64,
    /// The error of its component along any direction.
    pub(super) error: f64,
}

/// Returns all pairs of distinct points, the longest first.
pub(super) fn distinct_pairs(points: &[Vector], errors: &[f64]) -> Vec<PointPair> {
    let mut out = Vec::new();
    for i in 0..points.len() {
        for j in 0..i {
            let along = sub(points[i], points[j]);
            let error = SPREAD * (errors[i] + errors[j]);
            let length = length(along);
            if length > FAR * error {
                out.push(PointPair {
                    ends: [j, i],
                    along,
                    length,
                    error,
                });
            }
        }
    }
    out.sort_by(|a, b| b.length.total_cmp(&a.length));
    out
}

/// The error of a point along a direction, in errors of a coordinate. Three of them may add up to 1.73, but hardly do.
pub(super) const SPREAD: f64 = 1.5;
/// Distance of points, in errors, below which they do not determine a direction.
const FAR: f64 = 30.0;
