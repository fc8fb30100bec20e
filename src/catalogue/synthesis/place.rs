//! Places that are exact: whole millimetres, thousandths beside them, or whole ones after a third of a turn, whose coordinates
//! have a √3 in them; and points of the plane in double precision.

use crate::geom::vector::add_scaled;

/// Thousandths of a millimetre in one.
pub(super) const FINE: i32 = 1000;

/// A place in the plane.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Place {
    /// Whole millimetres.
    pub whole: [i32; 2],
    /// Thousandths of a millimetre beside them; none where it is turned.
    pub fine: [i32; 2],
    /// How often these are turned by 120° about the origin: 0, 1 or 2.
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
    /// Where it is before it is turned: of doubles the one nearest to the decimal.
    pub(super) fn unturned(self) -> [f64; 2] {
        let thousandths =
            |k: usize| f64::from(self.whole[k]) * f64::from(FINE) + f64::from(self.fine[k]);
        [0, 1].map(|k| thousandths(k) / f64::from(FINE))
    }

    /// In double precision.
    #[must_use]
    pub fn real(self) -> [f64; 2] {
        (0..self.thirds).fold(self.unturned(), |p, _| third(p))
    }
}

/// A point after a turn of 120° about the origin.
#[must_use]
pub(crate) fn third([x, y]: [f64; 2]) -> [f64; 2] {
    let half_root = 3.0_f64.sqrt() / 2.0;
    [-0.5 * x - half_root * y, half_root * x - 0.5 * y]
}

/// A point of the plane, in millimetres.
pub type Point = [f64; 2];

/// The middle of points.
#[must_use]
pub(crate) fn middle<const N: usize>(points: &[[f64; N]]) -> [f64; N] {
    #[allow(clippy::cast_precision_loss, reason = "a few")]
    let n = points.len().max(1) as f64;
    points
        .iter()
        .fold([0.0; N], |m, p| add_scaled(m, 1.0 / n, *p))
}
