//! Ranks in floating point, as methods.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, RankOfJ};
use crate::rank::numeric::Elimination;
use crate::rank::numeric::scaling::NumericRank;

/// LU with full pivoting in single precision, as a method.
pub(super) const LU32: MobilityMethod = MobilityMethod {
    name: "lu32",
    title: "f32 LU, full pivoting",
    help: "LU with full pivoting in single precision",
    rank: RankOfJ::Numeric(Elimination::Lu32),
    answer: |mechanism, state| Elimination::Lu32.answer(mechanism, state),
    ..LU
};

/// LU with full pivoting in double precision, as a method.
pub(super) const LU: MobilityMethod = MobilityMethod {
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
pub(super) const QR32: MobilityMethod = MobilityMethod {
    name: "qr32",
    title: "f32 QR, column pivoting",
    help: "Column-pivoted QR in single precision",
    rank: RankOfJ::Numeric(Elimination::Qr32),
    answer: |mechanism, state| Elimination::Qr32.answer(mechanism, state),
    ..QR
};

/// Column-pivoted QR in double precision, as a method.
pub(super) const QR: MobilityMethod = MobilityMethod {
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
pub(super) const SVD: MobilityMethod = MobilityMethod {
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
    /// Returns its name as a method.
    #[must_use]
    pub fn name(self) -> &'static str {
        [LU32, LU, QR32, QR, SVD][self as usize].name
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
