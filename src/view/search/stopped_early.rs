//! A search that ended before everything was looked at: what is known all the same.

use crate::score::outcome::Outcome;
use crate::search::answer::estimate::Estimate;
use crate::search::check::singular_values::Summary;
use crate::search::diagram::Stop;
use serde::Serialize;

/// Why a search ended early and what its counts and its list are; nothing of one that did not.
#[must_use]
pub fn stopped(outcome: &Outcome) -> Option<String> {
    let why = match outcome.stop {
        Stop::Exhausted => return None,
        Stop::NotCounted => "Not counted (--no-count)".to_owned(),
        stop => format!("Stopped early ({})", stop.word()),
    };
    // What is proven of a list is told after it.
    let list = match outcome.known_up_to() {
        Some(_) if !outcome.request.distinct => "",
        _ => ", variants are valid but may not be the cheapest",
    };
    Some(format!("{why}: counts are lower bounds{list}"))
}

/// About how many variants there are, where that is estimated.
#[must_use]
pub fn estimated(outcome: &Outcome) -> Option<String> {
    let [determinate, admissible] = outcome.estimates();
    let said = |e: Estimate, what| {
        let error = 100.0 * e.standard_error / e.mean;
        format!("about {:.2e} {what} (standard error {error:.2} %)", e.mean)
    };
    let first = admissible.map(|e| said(e, "admissible"));
    let second = determinate.map(|e| said(e, "determinate"));
    let how = admissible.or(determinate)?;
    let parts: Vec<String> = first.into_iter().chain(second).collect();
    Some(format!(
        "Estimated, not counted: {}, by {} random cuts of the diagram (--seed {})",
        parts.join(", "),
        how.cuts,
        how.seed
    ))
}

/// How much of a list by cost is proven, though the search ended early.
#[must_use]
pub fn proven(summary: &Summary) -> Option<String> {
    match summary.proven? {
        0 => None,
        n if n == summary.given => Some(format!("Proven the cheapest: all {n}")),
        n => Some(format!(
            "Proven the cheapest: the first {n}; the others are valid"
        )),
    }
}

/// An estimate as data.
#[derive(Debug, Serialize)]
pub(in crate::view) struct EstimateData {
    mean: f64,
    standard_error: f64,
    cuts: usize,
    seed: u64,
}

impl From<Estimate> for EstimateData {
    fn from(e: Estimate) -> Self {
        EstimateData {
            mean: e.mean,
            standard_error: e.standard_error,
            cuts: e.cuts,
            seed: e.seed,
        }
    }
}
