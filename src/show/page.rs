//! A report of one mechanism as one HTML page: the verdict, drawings, contours, and the redesigns to sort, filter and look at.
//!
//! The page is one file: it contains style, script and data, and its content policy forbids the network. Variants are
//! stored as columns of numbers and one symbol for each option of each joint, not as drawings. Names come from files,
//! so they enter as escaped text or JSON only.

use crate::format::plain::escape_direction;
use crate::redundancy::AnalysisError;
use crate::view::analysis::Analysis;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
pub use contents::{Commands, Page, Redesigns};
use itertools::Itertools;
use maud::{Markup, PreEscaped, html};
pub use scenes::{SHOWN, state_swaps};
use serde_json::Value;
use sha2::{Digest, Sha256};

#[cfg(feature = "store")]
pub mod catalogue;
mod contents;
mod explorer;
#[cfg(feature = "store")]
mod gripper;
#[doc(hidden)]
pub mod moving;
#[doc(hidden)]
pub mod scenes;
mod states;
mod variants;
#[doc(hidden)]
pub mod verdict;

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
    let data = contents::script_data(page, &analysis, found_columns(page)?);
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
                    (section(3, states::certainty_html(page, &analysis)))
                    (section(4, contents::commands_html(&page.commands.rows)))
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
    Ok(with_policy(
        &escape_direction(&markup.into_string()),
        POLICY,
    ))
}

pub(super) const STYLE: &str =
    concat!(include_str!("page/look.css"), include_str!("page/page.css"));

/// The placeholder of the policy until everything that it allows is written.
pub(super) const POLICY: &str = "default-src 'none'";

/// Returns the page with the policy that allows its scripts and styles, in place of the first `stand_in`. Text of mechanisms
/// is already escaped, so that every element found here belongs to the page.
pub(super) fn with_policy(page: &str, stand_in: &str) -> String {
    let (styles, scripts) = (
        element_hashes(page, "style"),
        element_hashes(page, "script"),
    );
    let policy = format!("{stand_in}; style-src {styles}; script-src {scripts}");
    page.replacen(stand_in, &policy, 1)
}

/// Returns the hashes of all elements of a name, each one once.
fn element_hashes(page: &str, element: &str) -> String {
    let (begin, end) = (format!("<{element}"), format!("</{element}>"));
    let inside = page.split(&begin).skip(1).filter_map(|after| {
        let (tag, inside) = after.split_once('>')?;
        // Data is not run.
        let data = tag.contains("application/json");
        (!data).then(|| inside.split(&end).next().unwrap_or(inside))
    });
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    inside.map(hash).unique().join(" ")
}

#[cfg(test)]
mod tests {
    use super::with_policy;

    #[test]
    fn scripts_and_styles_are_allowed_by_their_hashes() {
        let page = "<meta content=\"P\"><style>a</style><script type=\"application/json\">1</script><script>a</script>";
        // printf a | openssl dgst -sha256 -binary | base64
        let a = "'sha256-ypeBEsobvcr6wjGzmiPcTaeG7/gUfE5yuYB3ha/uSLs='";
        assert!(with_policy(page, "P").starts_with(&format!(
            "<meta content=\"P; style-src {a}; script-src {a}\">"
        )));
    }
}
