//! Position and size of a set of points, for arithmetic that should not depend on the unit or the origin.

use crate::geom::expr::Expr;
use crate::geom::vector::{Vector, length, sub};
use num_rational::BigRational;

/// Size, in the file's unit, below which sets are single points at the origin without a size.
const POINT: f64 = 1e-9;
/// Fraction of the coordinates below which differences are rounding errors.
const ROUNDING: f64 = 1e-9;

/// The middle of the bounding box of some points, and half its diagonal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The middle.
    pub middle: [f64; 3],
    /// Half the diagonal. If the points coincide up to rounding, their distance from the origin; 1 for the origin.
    pub length: f64,
}

/// Returns the corners of the bounding box of some points, or the origin if there are none.
fn box_corners(points: impl Iterator<Item = Vector> + Clone) -> [Vector; 2] {
    let bound = |pick: fn(f64, f64) -> f64| {
        let each = |a: Vector, b: Vector| std::array::from_fn(|i| pick(a[i], b[i]));
        points.clone().reduce(each).unwrap_or([0.0; 3])
    };
    [bound(f64::min), bound(f64::max)]
}

/// Returns the diagonal of the bounding box of some points, however small; 0 for one point and for none.
#[must_use]
pub fn box_diagonal(points: impl Iterator<Item = Vector> + Clone) -> f64 {
    let [low, high] = box_corners(points);
    length(sub(high, low))
}

impl Extent {
    /// Returns the extent of some points.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::extent::Extent;
    /// let extent = Extent::from_points(&[[0.0, 0.0, 0.0], [6.0, 8.0, 0.0]]);
    /// assert_eq!((extent.middle, extent.length), ([3.0, 4.0, 0.0], 5.0));
    /// ```
    #[must_use]
    pub fn from_points(points: &[[f64; 3]]) -> Extent {
        let [low, high] = box_corners(points.iter().copied());
        let diagonal = length(sub(high, low)) / 2.0;
        let far = low
            .iter()
            .chain(&high)
            .fold(0.0, |a: f64, x| a.max(x.abs()));
        let size = [(diagonal, ROUNDING * far), (far, 0.0)]
            .into_iter()
            .find(|&(l, least)| l > least && l > POINT)
            .map_or(1.0, |(l, _)| l);
        Extent {
            middle: [0, 1, 2].map(|i| f64::midpoint(low[i], high[i])),
            length: size,
        }
    }
}

/// The middle and the size of some points as exact numbers. Relative positions and lengths are rounded once, so that
/// they are the same numbers in every unit of length.
#[derive(Debug, Clone)]
pub struct OwnScale {
    middle: [Expr; 3],
    /// Half the longest side of the box, or its substitute.
    unit: Expr,
    /// Half the diagonal over that unit.
    diagonal: f64,
}

impl OwnScale {
    /// Returns the scale of some points; sizes are those of [`Extent::of`].
    #[must_use]
    pub fn from_points(points: &[&[Expr; 3]]) -> OwnScale {
        let zero = Expr::from(0);
        let along = |i: usize| points.iter().map(move |p| &p[i]);
        let least = |i: usize| along(i).min_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
        let most = |i: usize| along(i).max_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
        let ends = [0, 1, 2].map(|i| [least(i).unwrap_or(&zero), most(i).unwrap_or(&zero)]);
        let half = |x: Expr| &x * &Expr::rational(BigRational::new(1.into(), 2.into()));
        let halves = ends.map(|[low, high]| half(high - low));
        let size = |x: &Expr| x.to_f64().abs();
        let largest = |all: &[&Expr]| -> Expr {
            let found = all.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
            let found = found.map_or(&zero, |x| *x);
            if found.to_f64() < 0.0 {
                -found
            } else {
                found.clone()
            }
        };
        let side = largest(&halves.each_ref());
        let far = largest(&ends.concat());
        let by = |unit: &Expr, x: &Expr| x.div(unit).map_or(0.0, |x| x.to_f64());
        let (unit, diagonal) = if size(&side) > (ROUNDING * size(&far)).max(POINT) {
            let diagonal = length(halves.each_ref().map(|x| by(&side, x)));
            (side, diagonal)
        } else if size(&far) > POINT {
            (far, 1.0)
        } else {
            (Expr::from(1), 1.0)
        };
        OwnScale {
            middle: ends.map(|[low, high]| half(low + high)),
            unit,
            diagonal,
        }
    }

    /// Returns the extent in the file's unit.
    #[must_use]
    pub fn extent(&self) -> Extent {
        Extent {
            middle: self.middle.each_ref().map(Expr::to_f64),
            length: self.unit.to_f64() * self.diagonal,
        }
    }

    /// Returns the ratio of a length to that of the extent.
    #[must_use]
    pub fn relative_length(&self, x: &Expr) -> f64 {
        x.div(&self.unit).map_or(0.0, |x| x.to_f64()) / self.diagonal
    }

    /// Returns the length of the extent times a number per length.
    #[must_use]
    pub fn scaled_rate(&self, x: &Expr) -> f64 {
        (x * &self.unit).to_f64() * self.diagonal
    }

    /// Returns a point relative to the middle, over the length of the extent.
    #[must_use]
    pub fn relative_point(&self, point: &[Expr; 3]) -> Vector {
        [0, 1, 2].map(|i| self.relative_length(&(&point[i] - &self.middle[i])))
    }
}
