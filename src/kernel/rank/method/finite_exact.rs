//! Exact rank at the pose and the finite mobility, as a method.

use crate::closure::Closure;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::finite::finite;
use crate::rank::method::{About, Answer, Certainty, MobilityMethod, NoAnswer, Quantity, RankOfJ};

/// Exact rank at the pose, then [`finite`], as a method.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Exact;

impl MobilityMethod for Exact {
    fn about(&self) -> &'static About {
        &About {
            name: "finite",
            title: "finite mobility, exact geometry",
            help: "Exact rank, and the finite mobility",
            guarantee: "proven if groups or higher orders decide; otherwise followed numerically, or undecided",
            complexity: "one modular rank; otherwise about ten to a few hundred closings of O((6k)² f)",
            source: "Hervé 1978 (groups); Connelly & Whiteley 1996, Müller 2016 (second and higher order); Bates et al. 2009, Wampler, Hauenstein & Sommese 2011 (local dimension)",
            rank: RankOfJ::Exact,
        }
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let exact = field_of(mechanism, state, 0)?;
        let closure = Closure::new(&exact, mechanism, state)?;
        let rank = crate::rank::exact::modular::rank(&exact, &closure);
        let found = finite(&exact, mechanism, &closure, rank)?;
        if found.is_undecided() {
            return Err(NoAnswer::Failed(found.describe()));
        }
        Ok(Answer {
            mobility: i64::try_from(found.mobility).unwrap_or(i64::MAX),
            quantity: Quantity::Finite,
            certainty: if found.is_proven() {
                Certainty::Exact
            } else {
                Certainty::Traced
            },
        })
    }
}
