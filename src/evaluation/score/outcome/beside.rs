//! What is told beside the variants of an outcome.

use crate::score::outcome::Outcome;
use crate::score::outcome::symmetric::SymmetricBest;
use crate::search::answer::why_none::{Hopeless, Relaxation};
use crate::search::question::conditions::SearchError;
use num_bigint::BigUint;

/// What is told beside the variants: why there are none, and which are symmetric.
#[derive(Debug, Default)]
pub struct Beside {
    /// What easing one condition would leave.
    pub eased: Vec<(Relaxation, BigUint)>,
    /// What stands in the way of every variant.
    pub hopeless: Hopeless,
    /// The cheapest symmetric redesigns of a symmetric mechanism.
    pub symmetric: Option<SymmetricBest>,
}

impl Outcome {
    /// Returns what is told beside the variants, as far as there was time until `cancelled` said to end.
    ///
    /// # Errors
    /// Where the geometry has no exact image.
    pub fn beside(&self, cancelled: &(dyn Fn() -> bool + Sync)) -> Result<Beside, SearchError> {
        Ok(Beside {
            eased: self.relaxations(cancelled)?,
            hopeless: self.hopeless()?,
            symmetric: self.symmetric_best(cancelled)?,
        })
    }
}
