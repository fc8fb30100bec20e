//! A report of one mechanism as one HTML page: the verdict, drawings, contours, and the redesigns to sort, filter and look at.
//!
//! The page needs nothing beside it: style, script and data stand in the file, and its content policy forbids the
//! network. What a script shows of ten thousand variants is stored as columns of numbers and one symbol for each option
//! of each joint, not as ten thousand drawings. Names come from files, so they enter as escaped text or JSON only.

mod certainty;
mod commands;
mod embed;
mod figures;
mod states;
mod symbols;
mod variants;
mod verdict;
mod workload;

use crate::model::mechanism::Mechanism;
use crate::redundancy::analysis::{AnalysisError, StateAnalysis};
use crate::search::certify::{Certified, Summary};
use crate::view::search_json::Found;
use embed::{fill, script_json, text};
use serde_json::json;

pub use commands::Commands;

/// Everything a page tells.
#[derive(Debug)]
pub struct Page<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its figures in every state, in order.
    pub states: &'a [StateAnalysis],
    /// Its redesigns, or why none were searched.
    pub redesigns: Result<Redesigns<'a>, String>,
    /// How to get the same from the command line.
    pub commands: Commands,
}

/// What a search found.
#[derive(Debug)]
pub struct Redesigns<'a> {
    /// Counts and conditions.
    pub found: &'a Found<'a>,
    /// The variants of the page, in their order.
    pub variants: Vec<Certified>,
    /// What second opinions and other poses say of them.
    pub summary: Summary,
    /// Whether the giving was interrupted.
    pub interrupted: bool,
}

const TEMPLATE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
/// The script by idea, in the order it is run.
const SCRIPT: [&str; 7] = [
    include_str!("page/script/data.js"),
    include_str!("page/script/filter.js"),
    include_str!("page/script/table.js"),
    include_str!("page/script/drawing.js"),
    include_str!("page/script/chosen.js"),
    include_str!("page/script/chart.js"),
    include_str!("page/script/main.js"),
];

/// Writes the page.
///
/// # Errors
/// Where a coordinate of a variant has no value in the field of the search.
///
/// # Complexity
/// Two drawings a state; for each variant a rank in each further state, and a scoring where the file states loads.
pub fn html(page: &Page<'_>) -> Result<String, AnalysisError> {
    let m = page.mechanism;
    let drawn: Vec<symbols::Drawn> = m
        .state_ids()
        .map(|s| symbols::Drawn::new(page, s))
        .collect();
    let (store, swaps) = symbols::store(page, &drawn);
    let found = match &page.redesigns {
        Ok(r) if !r.variants.is_empty() => Some(variants::json(page, r)?),
        _ => None,
    };
    let data = json!({
        "format": 1,
        "mechanism": m.name,
        "length_unit": m.length_unit.symbol,
        "states": states::json(page),
        "joints": variants::joints(m),
        "search": found,
        "swaps": swaps,
        "variant_commands": page.commands.variant,
    });
    let sources: String = m
        .sources
        .iter()
        .map(|s| format!("<li>{}</li>\n", text(s)))
        .collect();
    let parts = [
        ("title", text(&m.name)),
        ("description", text(&m.description)),
        ("sources", sources),
        ("facts", states::facts(page)),
        ("style", STYLE.to_owned()),
        ("verdict", verdict::html(page)),
        ("states", states::html(page, &drawn)),
        ("redesigns", variants::html(page)),
        ("certainty", certainty::html(page)),
        ("commands", page.commands.html()),
        ("symbols", store),
        ("data", script_json(&data)),
        ("script", SCRIPT.concat()),
    ];
    Ok(fill(TEMPLATE, &parts))
}
