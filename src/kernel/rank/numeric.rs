//! Rank in floating point: from pivots or QR factors of the original J, or from singular values of J scaled so that
//! units do not matter.

pub mod scaling;
pub(in crate::rank) mod values;

use crate::closure::Closure;
pub use crate::rank::numeric::scaling::NumericRank;
use crate::rank::numeric::scaling::{as_it_stands, rank_of_values, scaled_matrix};
use ozols_dense::{Format, Matrix, singular_values};
use thiserror::Error;

/// Values below this fraction of the largest count as zero in double precision, unless the caller specifies a
/// tolerance.
pub const DEFAULT_TOLERANCE: f64 = 1e-9;
/// The same in single precision.
const SINGLE_TOLERANCE: f64 = 1e-4;

/// Reason why singular values could not be computed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NumericError {
    /// The decomposition did not converge, or an entry is not finite.
    #[error(
        "the singular values did not converge; check the coordinates for extreme values or use the exact method"
    )]
    NoConvergence,
}

/// A floating-point elimination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Elimination {
    /// LU with full pivoting, f32.
    Lu32,
    /// LU with full pivoting, f64.
    Lu,
    /// Column-pivoted QR, f32.
    Qr32,
    /// Column-pivoted QR, f64.
    Qr,
    /// Singular values of the scaled J, f64.
    Svd,
}

impl Elimination {
    /// All of them.
    pub const ALL: [Elimination; 5] = [
        Elimination::Lu32,
        Elimination::Lu,
        Elimination::Qr32,
        Elimination::Qr,
        Elimination::Svd,
    ];

    /// Returns the relative tolerance that suits its number format.
    #[must_use]
    pub fn default_tolerance(self) -> f64 {
        match self {
            Elimination::Lu32 | Elimination::Qr32 => SINGLE_TOLERANCE,
            Elimination::Lu | Elimination::Qr | Elimination::Svd => DEFAULT_TOLERANCE,
        }
    }

    /// Returns the rank of J, with values below this fraction of the largest treated as zero.
    ///
    /// # Errors
    /// Returns an error if the singular values do not converge.
    ///
    /// # Complexity
    /// O(6k · f · min(6k, f)).
    ///
    /// # Examples
    /// ```
    /// use ozols::{closure::Closure, geom::Reals, model::mechanism::StateId, rank::numeric::Elimination};
    /// let j = Closure::new(&Reals, &ozols::built_in("four-bar")?, StateId::FREE)?;
    /// let rank = Elimination::Svd.rank_of_closure(&j, Elimination::Svd.default_tolerance())?;
    /// assert_eq!(rank.rank, 3);
    /// assert!(rank.dropped < 1e-12); // A clear gap.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rank_of_closure(
        self,
        closure: &Closure<f64>,
        tolerance: f64,
    ) -> Result<NumericRank, NumericError> {
        let matrix = match self {
            Elimination::Svd => scaled_matrix(closure),
            _ => as_it_stands(closure),
        };
        self.rank_of(&matrix, tolerance)
    }

    /// Returns the rank of any matrix, without scaling.
    ///
    /// # Errors
    /// Returns an error if the singular values do not converge.
    pub fn rank_of(self, matrix: &Matrix, tolerance: f64) -> Result<NumericRank, NumericError> {
        let values = match self {
            Elimination::Lu32 => Format::Single.lu_pivots(matrix),
            Elimination::Lu => Format::Double.lu_pivots(matrix),
            Elimination::Qr32 => Format::Single.qr_diagonal(matrix),
            Elimination::Qr => Format::Double.qr_diagonal(matrix),
            Elimination::Svd => singular_values(matrix).ok_or(NumericError::NoConvergence)?,
        };
        Ok(rank_of_values(values, tolerance))
    }
}
