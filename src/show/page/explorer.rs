//! The parts that the script fills: the stage with the original mechanism and the chosen one, moved by one slider, and
//! the frame of the redesigns with filters, table and chart.

use super::contents::{Page, Redesigns, commands_html};
use super::scenes::SHOWN;
use crate::view::analysis::Analysis;
use crate::view::search::nothing_found::hopeless_reasons;
use crate::view::search::variant::symmetric_lines;
use crate::view::terminal::next_commands::typed_option;
use maud::{Markup, PreEscaped, html};
use num_traits::Zero;

/// The frame of the list, with filters, table and chart.
const FRAME: &str = include_str!("explorer.html");

/// The controls that turn and move both pictures, with a place for what they do not show, and the text about the choice.
const PLAYER: &str = include_str!("player.html");

pub(super) fn stage_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    let (before, after) = PLAYER.split_once("<!-- unshown -->").unwrap_or_default();
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
            (PreEscaped(before))
            (unshown_html(analysis))
            (PreEscaped(after))
        }
    }
}

/// Returns which idle freedoms and self-stresses are not among those that can be shown.
fn unshown_html(analysis: &Analysis<'_>) -> Markup {
    html! {
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

/// Returns the frame of the redesigns, or the reason why there are none.
pub(super) fn redesigns_html(page: &Page<'_>) -> Markup {
    match &page.redesigns {
        Err(why) => html! { p { "Redesigns were not searched: " (why) } },
        Ok(r) if r.variants.is_empty() => html! {
            @for why in empty_reasons(page, r) { p { (why) "." } }
            (commands_html(&page.commands.wider))
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
