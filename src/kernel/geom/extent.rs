//! Where a set of points is and how large it is, for arithmetic that should not depend on the unit or the origin.

use crate::geom::vector::{Vector, length, sub};

/// Sets smaller than this, in the file's unit, are single points at the origin and have no size.
const POINT: f64 = 1e-9;
/// Differences below this fraction of the coordinates are rounding errors.
const ROUNDING: f64 = 1e-9;

/// The middle of a box round some points, and half its diagonal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The middle.
    pub middle: [f64; 3],
    /// Half the diagonal; where the points are one point but for rounding, their distance from the origin; 1 for the origin.
    pub length: f64,
}

/// The corners of the box round some points; the origin where there are none.
fn corners(points: impl Iterator<Item = Vector> + Clone) -> [Vector; 2] {
    let bound = |pick: fn(f64, f64) -> f64| {
        let each = |a: Vector, b: Vector| std::array::from_fn(|i| pick(a[i], b[i]));
        points.clone().reduce(each).unwrap_or([0.0; 3])
    };
    [bound(f64::min), bound(f64::max)]
}

/// The diagonal of the box round some points, however small; 0 for one point and for none.
#[must_use]
pub fn diagonal(points: impl Iterator<Item = Vector> + Clone) -> f64 {
    let [low, high] = corners(points);
    length(sub(high, low))
}

impl Extent {
    /// The extent of some points.
    #[must_use]
    pub fn of(points: &[[f64; 3]]) -> Extent {
        let [low, high] = corners(points.iter().copied());
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
