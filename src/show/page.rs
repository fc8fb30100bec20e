//! A report of one mechanism as one HTML page: the verdict, drawings, contours, and the redesigns to sort, filter and look at.
//!
//! The page is one file: it contains style, script and data, and its content policy forbids the network. Variants are
//! stored as columns of numbers and one symbol for each option of each joint, not as drawings. Names come from files,
//! so they enter as escaped text or JSON only.

#[cfg(feature = "store")]
pub mod catalogue;
mod certainty;
mod contents;
mod data;
mod explorer;
#[cfg(feature = "store")]
mod gripper;
#[doc(hidden)]
pub mod moving;
mod policy;
#[doc(hidden)]
pub mod scenes;
mod states;
mod symbols;
mod variants;
#[doc(hidden)]
pub mod verdict;
mod workload;

use crate::format::plain::escape_direction;
use crate::redundancy::AnalysisError;
use crate::view::analysis::Analysis;
use maud::{Markup, PreEscaped, html};
use policy::{POLICY, STYLE};
use serde_json::Value;

pub use contents::{Commands, Page, Redesigns, SHOWN};
pub use symbols::named_swaps;
pub use symbols::state_swaps;

/// The scripts that the studio's page runs too, in their order.
pub const SHARED: [&str; 6] = [
    include_str!("page/script/element.js"),
    include_str!("page/script/hull.js"),
    include_str!("page/script/scene.js"),
    include_str!("page/script/closure.js"),
    include_str!("page/script/player.js"),
    include_str!("page/script/drag.js"),
];
/// The look that the studio's page has too.
pub const LOOK: &str = include_str!("page/look.css");
/// The script of the report by idea, in the order it is run, after what is shared.
const SCRIPT: [&str; 10] = [
    include_str!("page/script/data.js"),
    include_str!("page/script/filter.js"),
    include_str!("page/script/table.js"),
    include_str!("page/script/drawing.js"),
    include_str!("page/script/chosen.js"),
    include_str!("page/script/chart.js"),
    include_str!("page/script/turns.js"),
    include_str!("page/script/stage.js"),
    include_str!("page/script/keep.js"),
    include_str!("page/script/main.js"),
];
/// The sections that the table of contents names: their marks and heads.
const SECTIONS: [(&str, &str); 5] = [
    ("verdict", "Verdict"),
    ("redesigns", "Redesigns"),
    ("mechanism", "The original mechanism"),
    ("certainty", "How sure"),
    ("commands", "How to get this"),
];

/// Returns the search and its ideas as columns, if there are any.
fn found_columns(page: &Page<'_>) -> Result<[Option<Value>; 2], AnalysisError> {
    let columns = |r: Option<&Redesigns<'_>>| {
        let some = r.filter(|r| !r.variants.is_empty());
        some.map(|r| variants::variant_columns(page, r)).transpose()
    };
    Ok([
        columns(page.redesigns.as_ref().ok())?,
        columns(page.ideas.as_ref())?,
    ])
}

fn head_html(name: &str) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta name="viewport" content="width=device-width, initial-scale=1";
            meta name="color-scheme" content="light dark";
            meta http-equiv="Content-Security-Policy" content=(POLICY);
            title { (name) ": redundant constraints and redesigns" }
            style { (PreEscaped(STYLE)) }
        }
    }
}

/// Writes the page.
///
/// # Errors
/// Returns an error if a coordinate of a variant has no value in the field of the search.
///
/// # Complexity
/// Two drawings per state. For each variant a rank in each further state, and a scoring if the file states loads.
pub fn report_html(page: &Page<'_>) -> Result<String, AnalysisError> {
    let m = page.mechanism;
    let analysis = Analysis::new(m, page.states, &[]);
    let data = data::script_data(page, &analysis, found_columns(page)?);
    let section = |n: usize, inside: Markup| {
        let (mark, head) = SECTIONS[n];
        html! {
            section id=(mark) tabindex=[(mark == "redesigns").then_some("-1")] {
                h2 { (head) }
                (inside)
            }
        }
    };
    let markup = html! {
        (PreEscaped("<!doctype html>\n"))
        html lang="en" {
            (head_html(&m.name))
            body {
                a.skip href="#redesigns" { "Skip to the redesigns" }
                header {
                    h1 { (m.name) }
                    p.lead { (m.description) }
                    p.meta { (states::size_facts(m, &analysis)) }
                }
                nav aria-label="Contents" {
                    ul {
                        @for (mark, head) in SECTIONS {
                            li { a href={ "#" (mark) } { (head) } }
                        }
                    }
                }
                main {
                    div.front {
                        section id="verdict" aria-label="Verdict" { (verdict::verdict_html(page, &analysis)) }
                        (explorer::stage_html(page, &analysis))
                        (section(1, explorer::redesigns_html(page)))
                    }
                    (section(2, states::states_html(page, &analysis)))
                    (section(3, certainty::certainty_html(page, &analysis)))
                    (section(4, page.commands.commands_html()))
                    section id="sources" {
                        h2 { "Sources" }
                        ul { @for s in &m.sources { li { (s) } } }
                    }
                }
                script type="application/json" id="data" { (PreEscaped(data)) }
                script { @for part in SHARED.iter().chain(&SCRIPT) { (PreEscaped(part)) } }
            }
        }
        "\n"
    };
    Ok(policy::with_policy(
        &escape_direction(&markup.into_string()),
        POLICY,
    ))
}
