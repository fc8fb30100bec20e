//! About how many variants there are, and no more than how many, where they are not counted.

pub(in crate::search) mod samples;

use num_bigint::BigUint;
use num_traits::ToPrimitive;

/// How far the interval of an estimate is to reach on either side, in parts of the mean, where that takes no more than a second or so.
pub(in crate::search) const WITHIN: f64 = 0.01;

/// An estimate of a number of variants.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The mean of what was drawn, whose expected value is the number.
    pub mean: f64,
    /// The standard error of the mean.
    pub standard_error: f64,
    /// The least and the largest number that what was drawn does not contradict, with a confidence of 95 %.
    pub between: [f64; 2],
    /// A certain upper bound, if there is one.
    pub at_most: Option<BigUint>,
    /// The samples.
    pub drawn: Drawn,
    /// The seed of what was drawn.
    pub seed: u64,
}

impl Estimate {
    /// Returns the estimate with its bounds limited: at least `counted`, and no more than `possible`.
    #[must_use]
    pub(in crate::search) fn clamp_to_bounds(
        mut self,
        counted: &BigUint,
        possible: Option<&BigUint>,
    ) -> Self {
        self.at_most = self.at_most.iter().chain(possible).min().cloned();
        let value = |n: &BigUint| n.to_f64().unwrap_or(f64::INFINITY);
        let least = value(counted);
        let most = self
            .at_most
            .as_ref()
            .map_or(f64::INFINITY, value)
            .max(least);
        self.mean = self.mean.clamp(least, most);
        self.between = self.between.map(|x| x.clamp(least, most));
        self
    }
}

/// The samples of an estimate, drawn from a larger set that is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Drawn {
    /// How many samples were drawn.
    pub of: usize,
    /// How many of them are variants that are wanted.
    pub found: usize,
}
