//! Ideas in words: how many variants are minimal, and what a list of ideas is.

use crate::format::grouped;
use crate::score::outcome::Outcome;
use num_traits::Zero;

/// Above a list of ideas.
pub(in crate::view) const HEAD: &str = "ideas, cheapest first: each stands for all that give the same freedoms to the same joints in \
     series, and is shown by the one that leaves most as it is";

/// How many of the variants that are listed are minimal, and what the others are, said once; `None` where that was not counted.
pub(in crate::view) fn minimal(outcome: &Outcome) -> Option<String> {
    let minimal = outcome.minimal()?;
    let rest = &outcome.listed_counts().total - &minimal;
    if outcome.listed_counts().total.is_zero() {
        return None;
    }
    let all = grouped(&minimal);
    if rest.is_zero() {
        return Some("minimal: each of them, none does with less than another".to_owned());
    }
    let idle = match outcome.search.conditions.max_redundant {
        0 => "idle motion",
        _ => "freedoms",
    };
    let rest = grouped(&rest);
    Some(format!(
        "{all} minimal; the other {rest} only add {idle} to one of these"
    ))
}
