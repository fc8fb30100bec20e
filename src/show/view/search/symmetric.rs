//! The cheapest symmetric redesigns, for people and as data.

use crate::format::cost;
use crate::score::outcome::symmetric::SymmetricBest;
use crate::score::outcome::variant::{changes, in_words};
use crate::search::answer::k_best::Assignment;
use crate::view::search::variant::{ChangeData, Cost};
use serde::Serialize;
use std::fmt::Write;

/// Returns a line for each number of redundant constraints left, under a heading.
pub(in crate::view) fn text(found: &SymmetricBest) -> String {
    let SymmetricBest { search, best, odd } = found;
    let mut out = String::from("\n  the cheapest symmetric redesign for each σ left:\n");
    // Writing to a string cannot fail.
    for (left, v) in best {
        let price = cost(search.steps.milli(v.key.cost()));
        let (w, words) = (
            search.mobility(v.key),
            in_words(search, &changes(search, v)),
        );
        let _ = writeln!(out, "    σ = {left}: cost {price}, W = {w}, {words}");
    }
    if best.is_empty() {
        out += "    none with the options offered and at most 2 redundant constraints\n";
    }
    if let Some(odd) = odd {
        let _ = writeln!(
            out,
            "    none has σ = 0 without idle motion: it takes {} freedoms more, and joints that are alike get them {} at a time",
            odd.needed, odd.at_a_time
        );
    }
    out
}

/// A symmetric redesign as data.
#[derive(Debug, Serialize)]
pub(in crate::view) struct SymmetricData<'a> {
    redundant: u32,
    cost: Cost,
    mobility: i64,
    changes: Vec<ChangeData<'a>>,
}

/// Returns the redesigns as data.
pub(in crate::view) fn data(found: &SymmetricBest) -> Vec<SymmetricData<'_>> {
    let search = &found.search;
    let one = |(left, v): &(u32, Assignment)| SymmetricData {
        redundant: *left,
        cost: Cost::of(search.steps.milli(v.key.cost())),
        mobility: search.mobility(v.key),
        changes: ChangeData::of(&search.mechanism, changes(search, v)),
    };
    found.best.iter().map(one).collect()
}
