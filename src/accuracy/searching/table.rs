//! Ways of searching as a table for programs: one row for each mechanism and way.

use super::record::{Record, Share, Trial};
use crate::format::csv;
use serde::Serialize;

/// A row; the keys are a stable contract, in this order.
#[derive(Debug, Serialize)]
pub struct Row<'a> {
    mechanism: &'a str,
    way: String,
    about: &'static str,
    counts_right: Option<usize>,
    counts: Option<usize>,
    best_right: Option<usize>,
    best: Option<usize>,
    variants_right: usize,
    variants: usize,
    median_seconds: f64,
    least_seconds: f64,
    most_seconds: f64,
    repeats: usize,
    by_proportion: bool,
}

impl<'a> Row<'a> {
    fn new(trial: &'a Trial, record: &Record) -> Row<'a> {
        let right = |s: Option<Share>| s.map(|s| s.right);
        let of = |s: Option<Share>| s.map(|s| s.of);
        Row {
            mechanism: &trial.mechanism,
            way: record.way.to_string(),
            about: record.way.about(),
            counts_right: right(record.counts),
            counts: of(record.counts),
            best_right: right(record.best),
            best: of(record.best),
            variants_right: record.variants.right,
            variants: record.variants.of,
            median_seconds: record.time.median,
            least_seconds: record.time.least,
            most_seconds: record.time.most,
            repeats: record.time.repeats,
            by_proportion: record.by_proportion,
        }
    }
}

/// The rows of some trials.
#[must_use]
pub fn rows(trials: &[Trial]) -> Vec<Row<'_>> {
    let of = |t| move |r| Row::new(t, r);
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
