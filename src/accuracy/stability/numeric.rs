//! The floating-point methods, with any tolerance.

use crate::closure::matrix::Closure;
use crate::rank::lu::Lu;
use crate::rank::numeric::{self, NumericRank};
use crate::rank::qr::Qr;

/// A floating-point method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Numeric {
    /// LU in single precision.
    Lu32,
    /// LU in double precision.
    Lu,
    /// QR in single precision.
    Qr32,
    /// QR in double precision.
    Qr,
    /// Singular values of the scaled J.
    Svd,
}

impl Numeric {
    /// All of them.
    pub const ALL: [Numeric; 5] = [
        Numeric::Lu32,
        Numeric::Lu,
        Numeric::Qr32,
        Numeric::Qr,
        Numeric::Svd,
    ];

    /// Its name among the methods.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Numeric::Lu32 => "lu32",
            Numeric::Lu => "lu",
            Numeric::Qr32 => "qr32",
            Numeric::Qr => "qr",
            Numeric::Svd => "svd",
        }
    }

    /// The rank at a tolerance; none where the arithmetic fails.
    #[must_use]
    pub fn rank(self, closure: &Closure<f64>, tolerance: f64) -> Option<NumericRank> {
        Some(match self {
            Numeric::Lu32 => Lu::<f32>::with_tolerance(tolerance).rank(closure),
            Numeric::Lu => Lu::<f64>::with_tolerance(tolerance).rank(closure),
            Numeric::Qr32 => Qr::<f32>::with_tolerance(tolerance).rank(closure),
            Numeric::Qr => Qr::<f64>::with_tolerance(tolerance).rank(closure),
            Numeric::Svd => numeric::rank_with_tolerance(closure, tolerance).ok()?,
        })
    }

    /// The mobilities at several tolerances. A rank holds for every tolerance between the largest value dropped and the
    /// smallest kept, so that few decompositions serve many tolerances.
    #[must_use]
    pub fn mobilities(self, closure: &Closure<f64>, tolerances: &[f64]) -> Vec<Option<i64>> {
        let mut last: Option<NumericRank> = None;
        let of = |&t: &f64| {
            if last.is_none_or(|l| t < l.dropped || t >= l.kept) {
                last = self.rank(closure, t);
            }
            let free = closure.columns.len().checked_sub(last?.rank)?;
            i64::try_from(free).ok()
        };
        tolerances.iter().map(of).collect()
    }
}
