//! Rank from singular values in double precision, on J scaled so that units do not matter.

use super::method::{Answer, MobilityMethod, NoAnswer};
pub use super::scaled::NumericRank;
use super::scaled::{answer, rank_of_values, scaled};
use crate::closure::matrix::Closure;
use crate::geom::scalars::Reals;
use crate::model::mechanism::{Mechanism, StateId};
use thiserror::Error;

/// Singular values below this fraction of the largest count as zero unless the caller says otherwise.
pub const DEFAULT_TOLERANCE: f64 = 1e-9;

/// Why no singular values could be had.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NumericError {
    /// The decomposition did not converge, or an entry is not finite.
    #[error(
        "the singular values did not converge; check the coordinates for extreme values or use the exact method"
    )]
    NoConvergence,
}

/// Singular values of the scaled J, with the gap.
#[derive(Debug, Clone, Copy)]
pub struct Svd {
    /// Singular values below this fraction of the largest count as zero.
    pub tolerance: f64,
}

impl Svd {
    /// With [`DEFAULT_TOLERANCE`].
    pub const DEFAULT: Svd = Svd {
        tolerance: DEFAULT_TOLERANCE,
    };
}

/// Rank of J with the default tolerance, see [`rank_with_tolerance`].
///
/// # Errors
/// Where the decomposition fails.
pub fn rank(closure: &Closure<f64>) -> Result<NumericRank, NumericError> {
    rank_with_tolerance(closure, DEFAULT_TOLERANCE)
}

/// Rank of J by singular values. Lengths are divided by the largest velocity entry first and columns scaled to unit
/// length, so that the answer does not depend on the unit of length.
///
/// # Errors
/// Where the decomposition fails.
///
/// # Complexity
/// O(6k · f · min(6k, f)).
pub fn rank_with_tolerance(
    closure: &Closure<f64>,
    tolerance: f64,
) -> Result<NumericRank, NumericError> {
    let matrix = scaled(closure);
    if matrix.nrows() == 0 || matrix.ncols() == 0 {
        return Ok(rank_of_values(Vec::new(), tolerance));
    }
    let values = matrix
        .singular_values()
        .map_err(|_| NumericError::NoConvergence)?;
    if values.iter().any(|v| !v.is_finite()) {
        return Err(NumericError::NoConvergence);
    }
    Ok(rank_of_values(values, tolerance))
}

impl MobilityMethod for Svd {
    fn name(&self) -> &'static str {
        "svd"
    }
    fn title(&self) -> &'static str {
        "f64 singular values"
    }
    fn guarantee(&self) -> &'static str {
        "right at this pose where the gap in the singular values holds the tolerance"
    }
    fn complexity(&self) -> &'static str {
        "O(6k f min(6k, f)), some 10 times LU"
    }
    fn source(&self) -> &'static str {
        "Golub & Van Loan, Matrix Computations, 2013, 5.5.8"
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let closure = Closure::new(&Reals, mechanism, state)?;
        let rank = rank_with_tolerance(&closure, self.tolerance)
            .map_err(|e| NoAnswer::Failed(e.to_string()))?;
        Ok(answer(&closure, rank, self.tolerance))
    }
}
