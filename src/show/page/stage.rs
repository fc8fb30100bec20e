//! The stage beside the verdict: the mechanism as built, and next to it what is chosen, both moved by one slider.

use super::contents::{Page, SHOWN};
use crate::view::analysis::Analysis;
use maud::{Markup, PreEscaped, html};

pub(super) fn html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
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
            (player(analysis))
            (chosen())
        }
    }
}

/// What turns and moves both pictures.
fn player(analysis: &Analysis<'_>) -> Markup {
    html! {
        div.player id="player" role="group" aria-label="Motion" hidden {
            div.row data-moves {
                button type="button" data-part="play" { "Play" }
                input type="range" data-part="range" min="0" step="1" aria-label="Position";
                label.check data-part="again" { input type="checkbox" data-part="loop" checked; " Again and again" }
                button type="button" data-part="home" disabled { "First view" }
                button type="button" data-part="trace" aria-pressed="false" title="Then click a link: the way of that point is drawn" { "Trace a point" }
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
                    (s.idle.len(), "idle freedoms", "--motion --idle K"),
                    (s.self_stresses.len(), "self-stresses", "--self-stress K"),
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

/// What is told of the choice.
fn chosen() -> Markup {
    html! {
        div.chosen id="chosen" role="group" aria-labelledby="chosen-head" tabindex="0" hidden {
            h3 id="chosen-head" {}
            p id="chosen-words" role="status" aria-live="polite" {}
            div id="chosen-changes" {}
            div id="chosen-more" {}
        }
    }
}
