//! The parts that the script fills: the stage with the original mechanism and the chosen one, moved by one slider, and
//! the frame of the redesigns with filters, table and chart.

use super::contents::{Page, Redesigns};
use super::scenes::SHOWN;
use crate::view::analysis::Analysis;
use crate::view::search::nothing_found::hopeless_reasons;
use crate::view::search::variant::symmetric_lines;
use crate::view::terminal::next_commands::typed_option;
use maud::{Markup, PreEscaped, html};
use num_traits::Zero;

/// The frame of the list, with filters, table and chart.
const FRAME: &str = include_str!("explorer.html");

pub(super) fn stage_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    html! {
        section id="stage" aria-label="As built, and as chosen" {
            div.pair {
                figure.pane id="built" {
                    figcaption { span { "As built" } }
                    div.turn {
                        @for (i, scene) in page.scenes.iter().enumerate() {
                            @if let Some((drawing, _)) = scene {
                                div data-space=(i) hidden[i > 0] { (PreEscaped(&drawing.svg)) }
                            }
                        }
                    }
                }
                figure.pane id="drawing" hidden {
                    figcaption { span {} }
                    div.turn {}
                }
            }
            (player_html(analysis))
            (chosen_html())
        }
    }
}

/// Returns the controls that turn and move both pictures.
fn player_html(analysis: &Analysis<'_>) -> Markup {
    html! {
        div.player id="player" role="group" aria-label="Motion" hidden {
            div.row data-moves {
                button type="button" data-part="play" { "Play" }
                input type="range" data-part="range" min="0" step="1" aria-label="Position";
                label.check data-part="again" { input type="checkbox" data-part="loop" checked; " Loop" }
                button type="button" data-part="home" disabled { "First view" }
                button type="button" data-part="trace" aria-pressed="false" title="Then click a link to trace the path of that point" { "Trace a point" }
                button type="button" data-part="untrace" hidden { "No traces" }
            }
            div.switches {
                label id="drawn-state-field" { "State " select id="drawn-state" {} }
                label {
                    "Drawing "
                    select id="drawn-kind" {
                        option value="space" { "in motion" }
                        option value="kinematic" { "kinematic scheme" }
                        option value="scheme" { "structural scheme" }
                    }
                }
                label.shown data-moves { "Shown " select data-part="shown" {} }
            }
            span.help role="status" data-part="say" data-moves {}
            @for (i, s) in analysis.states.iter().enumerate() {
                @for (n, what, flags) in [
                    (s.found.idle.len(), "idle freedoms", typed_option("motion", typed_option("idle", "K"))),
                    (s.found.self_stresses.len(), "self-stresses", typed_option("self-stress", "K")),
                ] {
                    @if n > SHOWN {
                        span.help data-state-help=(i) {
                            "The first " (SHOWN) " of " (n) " " (what) " are here; " code { "ozols draw " (flags) } " draws any."
                        }
                    }
                }
            }
        }
    }
}

/// Returns the text about the choice.
fn chosen_html() -> Markup {
    html! {
        div.chosen id="chosen" role="group" aria-labelledby="chosen-head" tabindex="0" hidden {
            h3 id="chosen-head" {}
            p id="chosen-words" role="status" aria-live="polite" {}
            div id="chosen-changes" {}
            div id="chosen-more" {}
        }
    }
}

/// Returns the frame of the redesigns, or the reason why there are none.
pub(super) fn redesigns_html(page: &Page<'_>) -> Markup {
    match &page.redesigns {
        Err(why) => html! { p { "Redesigns were not searched: " (why) } },
        Ok(r) if r.variants.is_empty() => html! {
            @for why in empty_reasons(page, r) { p { (why) "." } }
            dl.commands {
                @for step in &page.commands.wider {
                    dt { (step.gives) }
                    dd { code { (step.command) } }
                }
            }
        },
        Ok(r) => html! {
            (PreEscaped(FRAME))
            @if let Some(found) = &r.remarks.symmetric {
                p { "The cheapest symmetric redesign for each number of redundant constraints left:" }
                ul { @for line in symmetric_lines(found) { li { (line) } } }
            }
        },
    }
}

/// Returns the reasons why no redesign is listed.
fn empty_reasons(page: &Page<'_>, r: &Redesigns<'_>) -> Vec<String> {
    if r.interrupted {
        return vec!["The search was interrupted before it listed a redesign".to_owned()];
    }
    if !r.found.listed_counts().total.is_zero() {
        let why = match r.found.ranking {
            Some(_) => {
                "None of the redesigns scored is in equilibrium within the limits of the ranking"
            }
            None => "Redesigns were counted, but none was asked for",
        };
        return vec![why.to_owned()];
    }
    let why = hopeless_reasons(page.mechanism, &r.remarks.hopeless);
    if !why.is_empty() || !page.commands.wider.is_empty() {
        return [vec!["No redesign meets the conditions".to_owned()], why].concat();
    }
    vec![
        "No redesign meets the conditions; allow more joint types under [search] or at the joints"
            .to_owned(),
    ]
}
