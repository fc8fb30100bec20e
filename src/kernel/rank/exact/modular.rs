//! Rank over a prime field.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::closure_of;
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, RankOfJ};
use std::borrow::Cow;

/// Returns the rank of J over the field. It is exact unless the prime divides a minor.
///
/// # Complexity
/// O(f² w) field operations for f columns that reach over w rows: all rows of J at worst, and those of neighbouring
/// contours in chains and bands.
#[must_use]
pub fn rank_modulo(exact: &ExactField, closure: &Closure<Residue>) -> usize {
    let columns = closure.dense_columns(exact);
    echelon::rank_of(exact.field(), columns.iter().map(Vec::as_slice))
}

/// A mechanism in a state, with its J in an exact field and the rank of J.
#[derive(Debug)]
pub(in crate::rank) struct ExactState<'a> {
    pub(in crate::rank) exact: &'a ExactField,
    pub(in crate::rank) mechanism: &'a Mechanism,
    pub(in crate::rank) closure: Cow<'a, Closure<Residue>>,
    pub(in crate::rank) rank: usize,
}

impl<'a> ExactState<'a> {
    /// Computes J of a state and its rank.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    pub(in crate::rank) fn new(
        exact: &'a ExactField,
        mechanism: &'a Mechanism,
        state: StateId,
    ) -> Result<Self, ExactError> {
        let closure = Closure::new(exact, mechanism, state)?;
        Ok(ExactState {
            exact,
            mechanism,
            rank: rank_modulo(exact, &closure),
            closure: Cow::Owned(closure),
        })
    }

    /// Returns the instantaneous mobility, f - rank J.
    pub(in crate::rank) fn mobility(&self) -> usize {
        self.closure.columns.len() - self.rank
    }
}

/// [`rank_modulo`] as a method.
pub(crate) const MODULAR: MobilityMethod = MobilityMethod {
    name: "modular",
    title: "rank modulo a prime",
    help: "Modulo two primes near 2^61; every digit is used exactly as written",
    guarantee: "exact at this pose except for primes that divide a minor; a rank modulo a prime is never too large",
    complexity: "O(f² 6k), much less for chains and grids of bounded width",
    source: "Schwartz 1980 (identities by evaluation)",
    rank: RankOfJ::Exact,
    answer: answer_modular,
};

fn answer_modular(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    let (exact, closure) = closure_of(mechanism, state, 0)?;
    let (freedoms, rank) = (closure.columns.len(), rank_modulo(&exact, &closure));
    Ok(Answer::at_pose(freedoms, rank, Certainty::Exact))
}
