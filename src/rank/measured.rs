//! Exact and tolerant rank side by side, for geometry that looks measured.

use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::scalars::Reals;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::modular;
use crate::rank::numeric::{NumericError, NumericRank, rank_with_tolerance};
use thiserror::Error;

/// Why no verdicts could be had.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum VerdictError {
    /// The geometry has no image in the field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The singular values failed.
    #[error(transparent)]
    Numeric(#[from] NumericError),
}

/// What both methods say of one state of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdicts {
    /// Name of the state.
    pub state: String,
    /// Freedoms f.
    pub freedoms: usize,
    /// Rows 6k.
    pub rows: usize,
    /// The rank with every digit taken at its word.
    pub exact: usize,
    /// The rank to within a tolerance.
    pub numeric: NumericRank,
}

impl Verdicts {
    /// Both verdicts on a state; the exact one is the larger of the ranks over the fields given, since a rank modulo a
    /// prime never exceeds the true one.
    ///
    /// # Errors
    /// Where the geometry has no exact image or the singular values fail.
    pub fn new(
        fields: &[ExactField],
        mechanism: &Mechanism,
        state: StateId,
        tolerance: f64,
    ) -> Result<Verdicts, VerdictError> {
        let mut exact = 0;
        for field in fields {
            let residues = Closure::new(field, mechanism, state)?;
            exact = exact.max(modular::rank(field, &residues));
        }
        let reals = Closure::new(&Reals, mechanism, state)?;
        let name = &mechanism.states[state];
        Ok(Verdicts::beside(exact, name, &reals, tolerance)?)
    }

    /// The tolerant verdict beside an exact one that is known.
    ///
    /// # Errors
    /// Where the singular values fail.
    pub(super) fn beside(
        exact: usize,
        state: &str,
        reals: &Closure<f64>,
        tolerance: f64,
    ) -> Result<Verdicts, NumericError> {
        Ok(Verdicts {
            state: state.to_owned(),
            freedoms: reals.columns.len(),
            rows: reals.rows(),
            exact,
            numeric: rank_with_tolerance(reals, tolerance)?,
        })
    }

    /// Whether they agree.
    #[must_use]
    pub fn agree(&self) -> bool {
        self.exact == self.numeric.rank
    }

    /// (W, σ) of a rank.
    #[must_use]
    pub fn figures(&self, rank: usize) -> (usize, usize) {
        (
            self.freedoms.saturating_sub(rank),
            self.rows.saturating_sub(rank),
        )
    }
}
