//! The original mechanism, state by state: figures, drawings, contours and self-stresses.

use crate::draw::{Subject, kinematic_with, scheme};
use crate::format::count_noun;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::page::contents::{Page, Redesigns};
use crate::page::scenes::state_swaps;
use crate::page::verdict;
use crate::view::analysis::{Analysis, State};
use crate::view::search::{counts, text};
use crate::view::terminal::Table;
use maud::{Markup, PreEscaped, html};

/// Returns a line on the mechanism's size.
pub(super) fn size_facts(m: &Mechanism, analysis: &Analysis<'_>) -> String {
    let plane = match m.mode {
        Mode::Planar { .. } => "planar, three equations a contour",
        Mode::Spatial => "spatial, six equations a contour",
    };
    let first = analysis.states.first();
    let [links, joints, contours] = first.map_or([0; 3], |s| {
        [s.found.links, s.found.joints, s.found.contours]
    });
    [
        count_noun(links, "link"),
        count_noun(joints, "joint"),
        count_noun(contours, "contour"),
        plane.to_owned(),
        format!("lengths in {}", m.length_unit.symbol),
    ]
    .join(" · ")
}

pub(super) fn states_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    let several = analysis.states.len() > 1;
    html! {
        @for (i, (s, id)) in analysis.states.iter().zip(page.mechanism.state_ids()).enumerate() {
            @if several {
                h3 id={ "state-" (i) } { "State " (s.found.state) ": " (verdict::verdict_head(s).to_lowercase()) }
            }
            (figures_html(s))
            (drawings_html(page, s, id))
            (tables_html(s))
        }
    }
}

/// Returns the two schemes. The kinematic one has room for the joints of redesigns.
fn drawings_html(page: &Page<'_>, s: &State<'_>, state: StateId) -> Markup {
    let subject = Subject {
        mechanism: page.mechanism,
        state,
        analysis: Some(s.found),
        marks: None,
    };
    let redesigns = page.redesigns.iter();
    let swaps = redesigns.flat_map(|r| state_swaps(page.mechanism, r.found, state));
    let swaps: Vec<_> = swaps.map(|(_, swap)| swap).collect();
    let kinematic = kinematic_with(&subject, &swaps);
    html! {
        div.drawings {
            @for (kind, name, drawn) in [
                ("scheme", "Structural scheme", scheme(&subject)),
                ("kinematic", "Kinematic scheme", kinematic),
            ] {
                figure.drawing data-state=(state.index()) data-kind=(kind) tabindex="0" role="group"
                    aria-label={ (name) ", state " (s.found.state) } {
                    "\n" (PreEscaped(drawn.svg))
                }
            }
        }
    }
}

/// Returns the counts of a state, and where σ comes from.
fn figures_html(s: &State<'_>) -> Markup {
    let lines = s.count_lines().into_iter().chain(s.external_line());
    html! {
        ul.figures { @for line in lines { li { (line) } } }
    }
}

/// Returns the tables of contours and self-stresses.
fn tables_html(s: &State<'_>) -> Markup {
    let Some(contours) = s.shares_table() else {
        return html! { p { "There is no closed contour, so nothing can be redundant." } };
    };
    html! {
        (table_html(
            "Contours. σ of a contour depends on the order in which contours are counted, and on the basis they are of; the \
             ranges are over all orders of these contours, and over all bases that have the contour.",
            &contours
        ))
        @if let Some(stresses) = s.stress_table() {
            (table_html(
                "Self-stresses: loads that inaccurate parts cause by themselves. Harmful ones strain the joints; harmless \
                 ones are friction shared between contacts.",
                &stresses
            ))
        }
    }
}

/// Returns a table that scrolls where it is too wide.
fn table_html(caption: &str, table: &Table) -> Markup {
    html! {
        div.wide tabindex="0" role="group" aria-label=(caption) {
            table.contours {
                caption { (caption) }
                thead { tr { @for head in table.heads.split(" | ") { th scope="col" { (head) } } } }
                tbody { @for row in &table.rows { tr { @for cell in row { td { (cell) } } } } }
            }
        }
    }
}

pub(super) fn certainty_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    let head = |s: &State<'_>| match analysis.states.len() {
        1 => "The mechanism".to_owned(),
        _ => format!("State {}", s.found.state),
    };
    html! {
        dl.facts {
            @for s in &analysis.states { (fact_row(&head(s), &state_lines(s))) }
            @if let Ok(r) = &page.redesigns { (fact_row("The search", &search_lines(r))) }
        }
    }
}

fn fact_row(head: &str, lines: &[String]) -> Markup {
    html! {
        dt { (head) }
        dd {
            @if let Some((first, rest)) = lines.split_first() {
                (first)
                @if !rest.is_empty() {
                    details {
                        summary { "Methods and checks" }
                        @for (i, line) in rest.iter().enumerate() {
                            @if i > 0 { br; "\n" }
                            (line)
                        }
                    }
                }
            }
        }
    }
}

fn state_lines(s: &State<'_>) -> Vec<String> {
    let mut lines = vec![s.certainty()];
    lines.extend(s.method_lines());
    lines.push(s.describe_finite());
    lines.extend(s.left_out());
    lines
}

fn search_lines(r: &Redesigns<'_>) -> Vec<String> {
    let found = r.found;
    let mut lines = counts::certainty_lines(found);
    if let Some((why, verdicts)) = &found.measured {
        let written = verdicts.iter().all(|v| v.is_as_written());
        let searched = if written {
            "exact and tolerant ranks agree on the original mechanism, and the search takes every digit exactly as written"
        } else if found.request.as_written {
            "something else is meant, and the search takes every digit exactly as written, as requested"
        } else {
            "the search uses the idealised geometry (snapped within the rounding of the file)"
        };
        lines.push(format!("The coordinates look rounded ({why}); {searched}"));
    }
    lines.extend(text::summary_notes(&r.summary));
    lines.extend(
        found
            .check
            .map(|c| format!("Primes: {} and {}", c.primes[0], c.primes[1])),
    );
    if r.interrupted {
        lines.push(format!(
            "Interrupted after {}",
            count_noun(r.variants.len(), "variant")
        ));
    }
    lines
}
