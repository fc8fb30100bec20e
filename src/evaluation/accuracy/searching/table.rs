//! Ways of searching as a table for programs: one row for each mechanism and way.

use super::record::{Record, Share, Trial};
use crate::format::csv;
use serde::Serialize;

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
