//! Where a set of points is and how large it is, for arithmetic that should not depend on the unit or the origin.

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

impl Extent {
    /// The extent of some points.
    #[must_use]
    pub fn of(points: &[[f64; 3]]) -> Extent {
        let bound = |i: usize, pick: fn(f64, f64) -> f64| {
            points.iter().map(|p| p[i]).reduce(pick).unwrap_or(0.0)
        };
        let low = [0, 1, 2].map(|i| bound(i, f64::min));
        let high = [0, 1, 2].map(|i| bound(i, f64::max));
        let half = [0, 1, 2].map(|i| (high[i] - low[i]) / 2.0);
        let diagonal = half.iter().map(|x| x * x).sum::<f64>().sqrt();
        let far = low
            .iter()
            .chain(&high)
            .fold(0.0, |a: f64, x| a.max(x.abs()));
        let length = [(diagonal, ROUNDING * far), (far, 0.0)]
            .into_iter()
            .find(|&(l, least)| l > least && l > POINT)
            .map_or(1.0, |(l, _)| l);
        Extent {
            middle: [0, 1, 2].map(|i| f64::midpoint(low[i], high[i])),
            length,
        }
    }
}
