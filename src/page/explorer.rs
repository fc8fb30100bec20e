//! The frame that the script fills with the redesigns: filters, table, chart, and the variant that is chosen.

use super::Page;
use maud::{Markup, html};

/// The frame, or why there is nothing to fill it with.
pub(super) fn html(page: &Page<'_>) -> Markup {
    match &page.redesigns {
        Err(why) => html! { p { "Redesigns were not searched: " (why) } },
        Ok(r) if r.variants.is_empty() => {
            html! { p { "There is no variant to show; the verdict at the top says why." } }
        }
        Ok(_) => frame(),
    }
}

fn frame() -> Markup {
    html! {
        noscript {
            p {
                "The list of redesigns needs scripts; "
                code { "ozols search" }
                " prints it."
            }
        }
        div id="explorer" hidden {
            p.note id="head" {}
            label.lists id="list-field" {
                "List "
                select id="list" {
                    option value="ideas" { "ideas: what is added, whichever joint in series has it" }
                    option value="variants" { "single variants" }
                }
            }
            (filters())
            p.note id="count" role="status" {}
            div.split {
                div.list { (table()) (chart()) }
                (chosen())
            }
        }
    }
}

fn filters() -> Markup {
    html! {
        form id="filters" aria-label="Filter the variants" {
            label.wide-field {
                "Find "
                input type="search" id="find" autocomplete="off" spellcheck="false"
                    placeholder="2-3:spherical universal" aria-describedby="find-help";
            }
            label { "Cost at most " input type="number" id="most-cost" min="0" step="0.5" inputmode="decimal"; }
            label { "Changes at most " input type="number" id="most-changes" min="0" step="1" inputmode="numeric"; }
            label { "W at most " input type="number" id="most-mobility" step="1" inputmode="numeric"; }
            label.check id="idle-field" { input type="checkbox" id="no-idle"; " No idle links" }
            button type="reset" { "Show all" }
            p.help id="find-help" { "Words that all must occur: a joint, a type, or joint:type. Escape clears." }
        }
    }
}

fn table() -> Markup {
    let turn = |id: &str, word: &str| html! { button type="button" id=(id) { (word) } };
    html! {
        div.wide id="table-room" {
            table id="variants" role="grid" aria-describedby="table-help" {
                caption id="table-caption" {}
                thead {}
                tbody {}
            }
        }
        div.pager role="group" aria-label="Pages of the table" {
            (turn("first", "First"))
            (turn("previous", "Previous"))
            span id="place" {}
            (turn("next", "Next"))
            (turn("last", "Last"))
        }
        p.help id="table-help" {
            "Column heads sort. In the table: arrow keys move, Enter chooses, Page Up and Page Down turn pages, Escape goes \
             back to the mechanism as it is."
        }
    }
}

fn chart() -> Markup {
    html! {
        figure id="chart" {
            figcaption {
                label { "Across " select id="axis-x" {} }
                label { "Up " select id="axis-y" {} }
                span id="chart-words" {}
            }
            div.wide id="chart-room" {}
        }
    }
}

fn chosen() -> Markup {
    html! {
        section.chosen id="chosen" aria-labelledby="chosen-head" tabindex="-1" {
            h3 id="chosen-head" {}
            p id="chosen-words" role="status" aria-live="polite" {}
            div id="chosen-changes" {}
            div.switches {
                label id="drawn-state-field" { "State " select id="drawn-state" {} }
                label {
                    "Drawing "
                    select id="drawn-kind" {
                        option value="scheme" { "structural scheme" }
                        option value="kinematic" { "kinematic scheme" }
                    }
                }
                button type="button" id="whole" { "Full size" }
            }
            figure.drawing id="drawing" tabindex="0" role="group" aria-label="Drawing of the chosen variant" {}
            div id="chosen-more" {}
        }
    }
}
