//! Rank in floating point: from pivots or QR factors of the original J, or from singular values of J scaled so that
//! units do not matter.

pub mod scaling;
pub(in crate::rank) mod values;

use super::method::{Answer, Certainty, MobilityMethod, NoAnswer, RankOfJ};
use crate::closure::Closure;
use crate::geom::Reals;
use crate::model::mechanism::{Mechanism, StateId};
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

    /// Returns its name as a method.
    #[must_use]
    pub fn name(self) -> &'static str {
        [LU32, LU, QR32, QR, SVD][self as usize].name
    }

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
    pub(crate) fn rank_of(
        self,
        matrix: &Matrix,
        tolerance: f64,
    ) -> Result<NumericRank, NumericError> {
        let values = match self {
            Elimination::Lu32 => Format::Single.lu_pivots(matrix),
            Elimination::Lu => Format::Double.lu_pivots(matrix),
            Elimination::Qr32 => Format::Single.qr_diagonal(matrix),
            Elimination::Qr => Format::Double.qr_diagonal(matrix),
            Elimination::Svd => singular_values(matrix).ok_or(NumericError::NoConvergence)?,
        };
        Ok(rank_of_values(values, tolerance))
    }

    /// Returns the certainty of a rank found at a tolerance.
    #[must_use]
    pub fn certainty_of(self, rank: NumericRank, tolerance: f64) -> Certainty {
        Certainty::Numeric {
            values: match self {
                Elimination::Lu32 => "f32 pivots",
                Elimination::Lu => "f64 pivots",
                Elimination::Qr32 => "f32 column-pivoted QR",
                Elimination::Qr => "f64 column-pivoted QR",
                Elimination::Svd => "f64 singular values",
            },
            tolerance,
            kept: rank.kept,
            dropped: rank.dropped,
        }
    }
}

/// Returns the rank of J by singular values. Lengths are first divided by the largest velocity entry and columns scaled
/// to unit length, so that the result does not depend on the unit of length.
///
/// # Errors
/// Returns an error if the decomposition fails.
pub(crate) fn rank_with_tolerance(
    closure: &Closure<f64>,
    tolerance: f64,
) -> Result<NumericRank, NumericError> {
    Elimination::Svd.rank_of_closure(closure, tolerance)
}

/// LU with full pivoting in single precision, as a method.
pub(in crate::rank) const LU32: MobilityMethod = MobilityMethod {
    name: "lu32",
    title: "f32 LU, full pivoting",
    help: "LU with full pivoting in single precision",
    rank: RankOfJ::Numeric(Elimination::Lu32),
    answer: |mechanism, state| Elimination::Lu32.answer(mechanism, state),
    ..LU
};

/// LU with full pivoting in double precision, as a method.
pub(in crate::rank) const LU: MobilityMethod = MobilityMethod {
    name: "lu",
    title: "f64 LU, full pivoting",
    help: "LU with full pivoting in double precision",
    guarantee: "right at this pose if the pivots are clear of the tolerance, for coordinates near 1",
    complexity: "O(6k f min(6k, f))",
    source: "Higham, Accuracy and Stability of Numerical Algorithms, 2002, ch. 9",
    rank: RankOfJ::Numeric(Elimination::Lu),
    answer: |mechanism, state| Elimination::Lu.answer(mechanism, state),
};

/// Column-pivoted QR in single precision, as a method.
pub(in crate::rank) const QR32: MobilityMethod = MobilityMethod {
    name: "qr32",
    title: "f32 QR, column pivoting",
    help: "Column-pivoted QR in single precision",
    rank: RankOfJ::Numeric(Elimination::Qr32),
    answer: |mechanism, state| Elimination::Qr32.answer(mechanism, state),
    ..QR
};

/// Column-pivoted QR in double precision, as a method.
pub(in crate::rank) const QR: MobilityMethod = MobilityMethod {
    name: "qr",
    title: "f64 QR, column pivoting",
    help: "Column-pivoted QR in double precision",
    guarantee: "right at this pose if the diagonal entries of R are clear of the tolerance, for coordinates near 1",
    complexity: "O(6k f min(6k, f))",
    source: "Golub & Van Loan, Matrix Computations, 2013, 5.4.2",
    rank: RankOfJ::Numeric(Elimination::Qr),
    answer: |mechanism, state| Elimination::Qr.answer(mechanism, state),
};

/// Singular values of the scaled J, as a method.
pub(in crate::rank) const SVD: MobilityMethod = MobilityMethod {
    name: "svd",
    title: "f64 singular values",
    help: "Singular values in double precision, with the gap",
    guarantee: "right at this pose if the gap in the singular values contains the tolerance",
    complexity: "O(6k f min(6k, f)), about 10 times LU",
    source: "Golub & Van Loan, Matrix Computations, 2013, 5.5.8",
    rank: RankOfJ::Numeric(Elimination::Svd),
    answer: |mechanism, state| Elimination::Svd.answer(mechanism, state),
};

impl Elimination {
    fn answer(self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let closure = Closure::new(&Reals, mechanism, state)?;
        let tolerance = self.default_tolerance();
        let rank = self
            .rank_of_closure(&closure, tolerance)
            .map_err(|e| NoAnswer::Failed(e.to_string()))?;
        let certainty = self.certainty_of(rank, tolerance);
        Ok(Answer::at_pose(closure.columns.len(), rank.rank, certainty))
    }
}
