//! Rank from QR factors with column pivoting, in single or double precision, on J as it stands.

use super::method::{Answer, MobilityMethod, NoAnswer};
use super::scaled::{
    NumericRank, Precision, answer, as_it_stands, diagonal, in_format, rank_of_values,
};
use crate::closure::matrix::Closure;
use crate::geom::scalars::Reals;
use crate::model::mechanism::{Mechanism, StateId};
use std::marker::PhantomData;

/// QR factors with column pivoting.
#[derive(Debug, Clone, Copy)]
pub struct Qr<T> {
    /// Diagonal entries of R below this fraction of the largest count as zero.
    pub tolerance: f64,
    precision: PhantomData<T>,
}

impl<T: Precision> Qr<T> {
    /// With the tolerance that suits the format.
    pub const DEFAULT: Self = Self::with_tolerance(T::TOLERANCE);

    /// With another tolerance.
    #[must_use]
    pub const fn with_tolerance(tolerance: f64) -> Self {
        Qr {
            tolerance,
            precision: PhantomData,
        }
    }

    /// The rank of J.
    #[must_use]
    pub fn rank(&self, closure: &Closure<f64>) -> NumericRank {
        let matrix = in_format::<T>(&as_it_stands(closure));
        let values = if matrix.nrows() == 0 || matrix.ncols() == 0 {
            Vec::new()
        } else {
            diagonal(matrix.col_piv_qr().R())
        };
        rank_of_values(values, self.tolerance)
    }
}

impl<T: Precision> MobilityMethod for Qr<T> {
    fn name(&self) -> &'static str {
        if T::NAME == "f32" { "qr32" } else { "qr" }
    }
    fn title(&self) -> &'static str {
        if T::NAME == "f32" {
            "f32 QR, column pivoting"
        } else {
            "f64 QR, column pivoting"
        }
    }
    fn guarantee(&self) -> &'static str {
        "right at this pose where the diagonal entries of R stay clear of the tolerance, for coordinates near 1"
    }
    fn complexity(&self) -> &'static str {
        "O(6k f min(6k, f))"
    }
    fn source(&self) -> &'static str {
        "Golub & Van Loan, Matrix Computations, 2013, 5.4.2"
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let closure = Closure::new(&Reals, mechanism, state)?;
        let rank = self.rank(&closure);
        Ok(answer(&closure, rank, self.tolerance))
    }
}
