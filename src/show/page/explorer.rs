//! The frame that the script fills with the redesigns: filters, table and chart.

use super::contents::Page;
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
            (filters())
            p.help {
                span id="count" role="status" {}
                ". "
                span id="head" {}
            }
            (table())
            (chart())
        }
    }
}

fn filters() -> Markup {
    html! {
        form id="filters" aria-label="Filter the variants" {
            label id="list-field" {
                "List "
                select id="list" title="An idea stands for all variants that give the same freedoms to the same joints in series" {
                    option value="ideas" { "ideas" }
                    option value="variants" { "single variants" }
                }
            }
            label.wide-field {
                "Find "
                input type="search" id="find" autocomplete="off" spellcheck="false"
                    placeholder="2-3:spherical universal" aria-describedby="find-help"
                    title="Words that all must occur: a joint, a type, or joint:type. Escape clears.";
            }
            label { "Cost ≤ " input type="number" id="most-cost" min="0" step="0.5" inputmode="decimal"; }
            label { "Changes ≤ " input type="number" id="most-changes" min="0" step="1" inputmode="numeric"; }
            label { "W ≤ " input type="number" id="most-mobility" step="1" inputmode="numeric"; }
            label.check id="idle-field" { input type="checkbox" id="no-idle"; " No idle links" }
            button type="reset" { "Show all" }
            span.unseen id="find-help" { "Words that all must occur: a joint, a type, or joint:type. Escape clears." }
        }
    }
}

fn table() -> Markup {
    let turn = |id: &str, word: &str| html! { button type="button" id=(id) { (word) } };
    html! {
        div.wide id="table-room" tabindex="0" role="group" aria-label="The list" {
            table id="variants" role="grid" aria-describedby="table-help" {
                caption { span id="table-caption" {} }
                thead {}
                tbody {}
            }
        }
        div.pager id="pager" role="group" aria-label="Pages of the table" {
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
            div.wide id="chart-room" tabindex="0" role="group" aria-label="The chart" {}
        }
    }
}
