//! Lower bounds on the terms of a ranking.

use crate::model::ranking::{Ranking, Term};

/// Lower bounds on terms, for every variant of a search.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Floor {
    /// On the greatest force over capacity.
    pub force: f64,
    /// On the greatest moment over capacity.
    pub moment: f64,
    /// On the error of the outputs `[m]`.
    pub output_error: f64,
}

impl Floor {
    /// Σ weight · bound over the terms but cost; those without a bound are at least 0.
    #[must_use]
    pub fn weighted(&self, ranking: &Ranking) -> f64 {
        ranking.terms.iter().map(|&(t, w)| w * self.of(t)).sum()
    }

    /// The bound on what a term adds to a sum.
    pub(in crate::score) fn of(&self, term: Term) -> f64 {
        match term {
            Term::PeakForce => self.force,
            Term::PeakMoment => self.moment,
            Term::OutputError => 1e3 * self.output_error,
            Term::Conditioning | Term::Changes | Term::Cost | Term::Idle | Term::Harmful => 0.0,
        }
    }
}
