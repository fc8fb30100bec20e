//! What ways of searching are worth.

use crate::accuracy::searching::search_method::Way;
use crate::accuracy::timing::Timing;
use num_bigint::BigUint;

/// Right ones of how many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Share {
    /// Right ones.
    pub right: usize,
    /// All.
    pub of: usize,
}

impl Share {
    /// Wrong ones of a hundred; none of none.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    pub(crate) fn percent_wrong(self) -> f64 {
        100.0 * (self.of - self.right) as f64 / self.of.max(1) as f64
    }
}

/// What a way of searching is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The way.
    pub way: Way,
    /// How long it takes to count, or to look at all; `None` where it counts as another way does.
    pub counting: Option<Timing>,
    /// How long it takes to count and to name the best; `None` where it names none.
    pub naming: Option<Timing>,
    /// Whether the time is that of the variants looked at, in proportion to all.
    pub by_proportion: bool,
    /// Right counts of determinate and of admissible variants, by W and number of changes; `None` where it gives none, or the
    /// truth is not known.
    pub counts: Option<Share>,
    /// How many of the best it names are among them; `None` where it names none, or the truth is not known.
    pub best: Option<Share>,
    /// Variants looked at one by one that it judges rightly.
    pub variants: Share,
}

/// Every way of searching one mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The mechanism.
    pub mechanism: String,
    /// Its variants.
    pub space: BigUint,
    /// Those that are determinate and those that are admissible in truth; `None` where the node budget is too small for it.
    pub found: Option<[BigUint; 2]>,
    /// Variants looked at one by one.
    pub looked: usize,
    /// Whether those are all.
    pub whole: bool,
    /// How many of the best are asked for.
    pub top: usize,
    /// The largest pool that was ranked, and whether no variant outside of it can win: only then the best are judged. `None`
    /// without a ranking.
    pub ranked: Option<(usize, bool)>,
    /// What each way is worth.
    pub records: Vec<Record>,
}
