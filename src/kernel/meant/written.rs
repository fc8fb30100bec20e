//! What is written: points and directions, each number with half a unit of its last digit.

use super::number::Rational3;
use crate::geom::vector::{Vector, dot, length, sub, unit};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// A point as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenPoint {
    /// Its coordinates.
    pub value: Vector,
    /// The same exactly.
    pub exact: Rational3,
    /// Half a unit of the last digit of each; 0 where it is exact.
    pub half: Vector,
}

/// A direction as it is written, of any length; its sign says nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Ray {
    /// Its components.
    pub value: Vector,
    /// The same exactly.
    pub exact: Rational3,
    /// Half a unit of the last digit of each; 0 where it is exact.
    pub half: Vector,
}

/// Points and directions of a scene that are each other's images, or their own, as a file states it.
#[derive(Debug, Clone)]
pub struct WrittenSymmetry {
    /// Whether half a turn carries them over, and not a mirror.
    pub turned: bool,
    /// Pairs of points; a point that is its own image with itself.
    pub points: Vec<[usize; 2]>,
    /// Pairs of rays; a ray that is its own image with itself.
    pub rays: Vec<[usize; 2]>,
}

/// The geometry of a file as it is written.
#[derive(Debug, Clone, Default)]
pub struct WrittenScene {
    /// Its points.
    pub points: Vec<WrittenPoint>,
    /// Its directions.
    pub rays: Vec<Ray>,
    /// What it states of images.
    pub symmetry: Option<WrittenSymmetry>,
}

/// Relative errors of double precision, times ten: no number is known better.
const DOUBLE: f64 = 2e-15;

impl WrittenScene {
    /// The largest distance between two points; 1 where there is one place alone.
    pub(super) fn size(&self) -> f64 {
        let of = |i: usize| {
            let each = self.points.iter().map(move |p| p.value[i]);
            each.clone().fold(f64::MIN, f64::max) - each.fold(f64::MAX, f64::min)
        };
        let size = length([of(0), of(1), of(2)]);
        if size.is_finite() && size > 0.0 {
            size
        } else {
            1.0
        }
    }

    /// The same with lengths ten times larger so many times; none where that is too large or small for doubles.
    pub(super) fn resized(&self, power: i32) -> Option<WrittenScene> {
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

    /// The farthest coordinate from zero, that double precision is relative to.
    fn reach(&self) -> f64 {
        let all = self.points.iter().flat_map(|p| p.value);
        all.fold(0.0, |a: f64, x| a.max(x.abs()))
    }

    /// The least error of a coordinate: that of double precision.
    pub(super) fn floor(&self) -> f64 {
        DOUBLE * self.reach().max(self.size())
    }

    /// How far each point may be from where it is written, in each coordinate.
    pub(super) fn errors(&self) -> Vec<f64> {
        let least = self.floor();
        let largest = |p: &WrittenPoint| p.half.iter().fold(least, |a, &h| a.max(h));
        self.points.iter().map(largest).collect()
    }
}

impl Ray {
    /// Its unit vector.
    pub(super) fn unit(&self) -> Vector {
        unit(self.value)
    }

    /// The angle that it may be off by `[rad]`; 0 where it is exact.
    pub(super) fn error(&self) -> f64 {
        if self.is_exact() {
            return 0.0;
        }
        (length(self.half) / length(self.value)).max(DOUBLE)
    }

    /// How far its components would move, in halves of their last digits or what is least, to have a direction.
    pub(super) fn moved(&self, v: Vector, least: f64) -> f64 {
        let least = least.max(DOUBLE * length(self.value));
        let at = |along: f64| {
            (0..3)
                .map(|k| (along * v[k] - self.value[k]).abs() / self.half[k].max(least))
                .fold(0.0, f64::max)
        };
        // A component that is exact says how long the direction is, if any is.
        let exact = (0..3).filter(|&k| self.half[k] == 0.0 && self.value[k] != 0.0 && v[k] != 0.0);
        exact
            .map(|k| at(self.value[k] / v[k]))
            .fold(at(dot(v, self.value) / dot(v, v)), f64::min)
    }

    /// Whether every component is exact.
    pub(super) fn is_exact(&self) -> bool {
        self.half == [0.0; 3]
    }
}

/// Two points' difference, and how far each of its components may be off.
pub(super) struct PointPair {
    pub(super) ends: [usize; 2],
    pub(super) along: Vector,
    pub(super) length: f64,
    /// The error of its component along any direction.
    pub(super) error: f64,
}

/// All pairs of points that are not one, the longest first.
pub(super) fn pairs(points: &[Vector], errors: &[f64]) -> Vec<PointPair> {
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

/// The error of a point along a direction, in errors of a coordinate: three of them may add up to 1.73, and hardly do.
pub(super) const SPREAD: f64 = 1.5;
/// Points nearer than so many errors say nothing of a direction.
const FAR: f64 = 30.0;
