//! Places that are exact: whole millimetres, or those after a third of a turn, whose coordinates have a √3 in them.

/// A place in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Whole millimetres.
    pub whole: [i32; 2],
    /// How often these are turned by 120° about the origin: 0, 1 or 2.
    pub thirds: u8,
}

impl From<[i32; 2]> for Place {
    fn from(whole: [i32; 2]) -> Place {
        Place { whole, thirds: 0 }
    }
}

impl Place {
    /// In double precision.
    #[must_use]
    pub fn real(self) -> [f64; 2] {
        (0..self.thirds).fold(self.whole.map(f64::from), |p, _| third(p))
    }
}

/// A point after a turn of 120° about the origin.
#[must_use]
pub fn third([x, y]: [f64; 2]) -> [f64; 2] {
    let half_root = 3.0_f64.sqrt() / 2.0;
    [-0.5 * x - half_root * y, half_root * x - 0.5 * y]
}
