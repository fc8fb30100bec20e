//! Results of a search that ended early.

use crate::search::answer::estimate::{Drawn, Estimate};
use crate::search::check::singular_values::Summary;
use crate::search::diagram::Stop;
use crate::view::prelude::*;
use num_bigint::BigUint;

/// Describes why a search ended early, and what its counts and its list are. `None` if it did not end early.
pub(crate) fn stopped_line(outcome: &Outcome) -> Option<String> {
    let why = match outcome.stop {
        Stop::Exhausted => return None,
        Stop::NotCounted => format!("Not counted ({})", typed_option("no-count", "")),
        stop => format!("Stopped early ({})", stop.word()),
    };
    // What is proven of a list is told after it.
    let list = match outcome.known_up_to() {
        Some(_) if !outcome.request.distinct => "",
        _ => ", variants are valid but may not be the cheapest",
    };
    Some(format!("{why}: counts are lower bounds{list}"))
}

/// Formats a number of variants. One that is not exact is a lower bound, with an upper bound and an estimate if they are known.
pub(crate) fn format_count(counted: &BigUint, exact: bool, estimate: Option<&Estimate>) -> String {
    let own = group_thousands(counted);
    match estimate {
        _ if exact => own,
        None => format!("at least {own}"),
        Some(e) => match &e.at_most {
            None => format!("at least {own}, about {:.3e},", e.mean),
            Some(most) if most == counted => own,
            Some(most) => format!("{own} to {}, about {:.3e},", group_thousands(most), e.mean),
        },
    }
}

/// Describes how the numbers of variants that are not counted are known.
pub(crate) fn estimate_line(outcome: &Outcome) -> Option<String> {
    let [determinate, admissible] = outcome.estimates();
    let said = |e: &Estimate, what| {
        let [low, high] = e.between;
        let Drawn { of, found } = e.drawn;
        format!(
            "{low:.3e} to {high:.3e} {what} ({} of {} samples of those not ruled out)",
            group_thousands(found),
            group_thousands(of)
        )
    };
    let first = admissible.map(|e| said(e, "admissible"));
    let second = determinate.map(|e| said(e, "determinate"));
    let how = admissible.or(determinate)?;
    let parts: Vec<String> = first.into_iter().chain(second).collect();
    Some(format!(
        "Estimated, not counted, with 95 % confidence: {} ({})",
        parts.join(", "),
        typed_option("seed", how.seed)
    ))
}

/// Returns the price of a larger budget, if one ended the search: time and memory grow in proportion to nodes.
pub(crate) fn more_line(outcome: &Outcome) -> Option<String> {
    match outcome.stop {
        Stop::NodeBudget => {
            let nodes = typed_option("nodes", outcome.request.nodes.saturating_mul(10));
            Some(format!(
                "With {nodes} more is counted, in about ten times the time and memory"
            ))
        }
        Stop::Memory => Some(format!(
            "More is counted where there is more memory ({}), not with more nodes",
            typed_option("memory", "")
        )),
        Stop::Exhausted | Stop::Interrupted | Stop::NotCounted => None,
    }
}

/// Describes how much of a list by cost is proven, although the search ended early.
pub(crate) fn proven_line(summary: &Summary) -> Option<String> {
    match summary.proven? {
        0 => None,
        n if n == summary.given => Some(format!("Proven the cheapest: all {n}")),
        n => Some(format!(
            "Proven the cheapest: the first {n}; the others are valid"
        )),
    }
}

/// Returns an estimate as data; `between` is the interval with a confidence of 95 %.
pub(crate) fn estimate_json(e: &Estimate) -> Value {
    let Drawn { of, found } = e.drawn;
    json!({
        "mean": e.mean,
        "standard_error": e.standard_error,
        "between": e.between,
        "at_most": e.at_most.as_ref().map(ToString::to_string),
        "samples": { "of": of, "found": found },
        "seed": e.seed,
    })
}
