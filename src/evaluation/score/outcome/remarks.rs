//! Remarks on an outcome: why there are no variants, and which redesigns are symmetric.

use crate::score::outcome::Outcome;
use crate::score::outcome::symmetric::SymmetricBest;
use crate::search::answer::why_none::{Hopeless, Relaxation};
use crate::search::question::conditions::SearchError;
use num_bigint::BigUint;

/// Remarks on the variants of a search.
#[derive(Debug, Default)]
pub struct Remarks {
    /// What easing one condition would leave.
    pub eased: Vec<(Relaxation, BigUint)>,
    /// What stands in the way of every variant.
    pub hopeless: Hopeless,
    /// The cheapest symmetric redesigns of a symmetric mechanism.
    pub symmetric: Option<SymmetricBest>,
}

impl Outcome {
    /// Returns the remarks on the variants, as far as there was time until `cancelled` said to end.
    ///
    /// # Errors
    /// Where the geometry has no exact image.
    pub fn remarks(&self, cancelled: &(dyn Fn() -> bool + Sync)) -> Result<Remarks, SearchError> {
        Ok(Remarks {
            eased: self.relaxations(cancelled)?,
            hopeless: self.hopeless()?,
            symmetric: self.symmetric_best(cancelled)?,
        })
    }
}
