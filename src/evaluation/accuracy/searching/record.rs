//! What ways of searching are worth, and the table of it for programs: one row for each mechanism and way.

use crate::accuracy::searching::search_method::Way;
use crate::accuracy::timing::Timing;
use crate::format::csv;
use num_bigint::BigUint;
use serde::Serialize;

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
    /// Nodes of a search that was stopped, and how wide its bracket of the determinate variants is, in per cent of the estimate.
    pub bracket: Option<(f64, f64)>,
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

/// A row; the keys are a stable contract, in this order.
#[derive(Debug, Serialize)]
pub struct TrialRow<'a> {
    mechanism: &'a str,
    way: String,
    about: &'static str,
    counts_right: Option<usize>,
    counts: Option<usize>,
    best_right: Option<usize>,
    best: Option<usize>,
    variants_right: usize,
    variants: usize,
    median_seconds: Option<f64>,
    least_seconds: Option<f64>,
    most_seconds: Option<f64>,
    repeats: Option<usize>,
    by_proportion: bool,
    naming_median_seconds: Option<f64>,
    naming_least_seconds: Option<f64>,
    naming_most_seconds: Option<f64>,
    naming_repeats: Option<usize>,
    bracket_percent: Option<f64>,
}

impl<'a> TrialRow<'a> {
    fn new(trial: &'a Trial, record: &Record) -> TrialRow<'a> {
        let right = |s: Option<Share>| s.map(|s| s.right);
        let of = |s: Option<Share>| s.map(|s| s.of);
        TrialRow {
            mechanism: &trial.mechanism,
            way: record.way.to_string(),
            about: record.way.about(),
            counts_right: right(record.counts),
            counts: of(record.counts),
            best_right: right(record.best),
            best: of(record.best),
            variants_right: record.variants.right,
            variants: record.variants.of,
            median_seconds: record.counting.map(|t| t.median),
            least_seconds: record.counting.map(|t| t.least),
            most_seconds: record.counting.map(|t| t.most),
            repeats: record.counting.map(|t| t.repeats),
            by_proportion: record.by_proportion,
            naming_median_seconds: record.naming.map(|t| t.median),
            naming_least_seconds: record.naming.map(|t| t.least),
            naming_most_seconds: record.naming.map(|t| t.most),
            naming_repeats: record.naming.map(|t| t.repeats),
            bracket_percent: record.bracket.map(|b| b.1),
        }
    }
}

/// The rows of some trials.
#[must_use]
pub fn rows(trials: &[Trial]) -> Vec<TrialRow<'_>> {
    let of = |t| move |r| TrialRow::new(t, r);
    trials
        .iter()
        .flat_map(|t| t.records.iter().map(of(t)))
        .collect()
}

/// The rows of some trials as CSV.
#[must_use]
pub fn csv(trials: &[Trial]) -> String {
    csv::records(rows(trials))
}
