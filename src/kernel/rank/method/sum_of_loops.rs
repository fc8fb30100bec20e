//! Sum over independent contours of the dimension of each one's twist space.

use crate::closure::Closure;
use crate::linalg::echelon;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::method::{About, Answer, Certainty, MobilityMethod, NoAnswer, Quantity, RankOfJ};

/// W = f - Σ rank of contour i, over a minimum cycle basis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Loops;

impl MobilityMethod for Loops {
    fn about(&self) -> &'static About {
        &About {
            name: "loops",
            title: "sum of contour ranks",
            help: "Freedoms minus the ranks of the separate contours",
            guarantee: "right if contours do not share redundant constraints; otherwise too small, and dependent on the cycle basis [Gogu 2005]",
            complexity: "O(f) eliminations of six rows",
            source: "Voinea & Atanasiu 1959; Gogu 2005",
            rank: RankOfJ::NotFound,
        }
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let exact = field_of(mechanism, state, 0)?;
        let closure = Closure::new(&exact, mechanism, state)?;
        let mut mobility = i64::try_from(closure.columns.len()).unwrap_or(i64::MAX);
        for k in 0..closure.contours.len() {
            let columns: Vec<_> = (0..closure.columns.len())
                .filter(|&c| {
                    closure.contours[k]
                        .direction(closure.columns[c].joint)
                        .is_some()
                })
                .map(|c| closure.dense_column(&exact, c, &[k]))
                .collect();
            let rank = echelon::rank(exact.field(), columns.iter().map(Vec::as_slice));
            mobility -= i64::try_from(rank).unwrap_or(0);
        }
        // A coupling is a separate row, of rank 1.
        mobility -= i64::try_from(closure.couplings.len()).unwrap_or(0);
        Ok(Answer {
            mobility,
            quantity: Quantity::Count,
            certainty: Certainty::Exact,
        })
    }
}
