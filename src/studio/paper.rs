//! The page: its frame, its scripts and its style. The report and the studio draw with the same scripts.

use crate::draw::SHEET_STYLE;
use crate::page::{LOOK, SHARED};
use maud::{DOCTYPE, Markup, html};

/// The studio's own scripts by idea, in the order they are run, after those that the report's page shares with it.
const SCRIPTS: [&str; 21] = [
    include_str!("script/talk.js"),
    include_str!("script/things.js"),
    include_str!("script/number.js"),
    include_str!("script/units.js"),
    include_str!("script/camera.js"),
    include_str!("script/preview.js"),
    include_str!("script/sheet.js"),
    include_str!("script/snap.js"),
    include_str!("script/build.js"),
    include_str!("script/tools.js"),
    include_str!("script/pointer.js"),
    include_str!("script/measure.js"),
    include_str!("script/inspect.js"),
    include_str!("script/search.js"),
    include_str!("script/verdict.js"),
    include_str!("script/ideas.js"),
    include_str!("script/text.js"),
    include_str!("script/curves.js"),
    include_str!("script/shelf.js"),
    include_str!("script/keys.js"),
    include_str!("script/main.js"),
];
const STYLES: [&str; 3] = [SHEET_STYLE, LOOK, include_str!("studio.css")];

/// The picture of the window's tab.
pub(super) const ICON: &str = include_str!("icon.svg");

pub(super) fn whole_script() -> String {
    [SHARED.concat(), SCRIPTS.concat()].concat()
}

pub(super) fn whole_style() -> String {
    STYLES.concat()
}

/// Returns the frame of the page, which the scripts fill.
pub(super) fn page_html() -> String {
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "ozols studio" }
                link rel="icon" href="icon.svg";
                link rel="stylesheet" href="studio.css";
                script src="studio.js" defer {}
            }
            body {
                (bar_html())
                div id="notices" {}
                main {
                    (stage_html())
                    (side_html())
                }
                dialog id="shelf" aria-labelledby="shelf-head" {}
                dialog id="help" aria-labelledby="help-head" {}
                p id="said" class="unseen" role="status" aria-live="polite" {}
                noscript { p { "The studio is a page of scripts, all of which come from this machine." } }
            }
        }
    };
    markup.into_string()
}

/// Returns the head of the page: the file and its commands.
fn bar_html() -> Markup {
    let button = |id: &str, words: &str, tip: &str| html! { button type="button" id=(id) title=(tip) { (words) } };
    html! {
        header id="bar" {
            h1 id="name" { "ozols studio" }
            span id="file" {}
            div role="toolbar" aria-label="File" id="file-tools" {
                (button("new", "New", "Start from an example, a file or the tutorial (N)"))
                (button("undo", "Undo", "Undo (Ctrl+Z)"))
                (button("redo", "Redo", "Redo (Ctrl+Y)"))
                (button("save", "Save", "Save the file (Ctrl+S)"))
                label { span.unseen { "Export as" } select id="export" { option value="" { "Export" } } }
                (button("show-help", "Keys", "All keys (?)"))
            }
        }
    }
}

fn stage_html() -> Markup {
    html! {
        section id="stage" aria-label="Drawing" {
            div id="tools" role="toolbar" aria-label="Tools" aria-orientation="vertical" {}
            div id="sheet-room" {
                div id="views" role="toolbar" aria-label="View" {}
                div id="sheet" class="turn" tabindex="0" role="application" aria-roledescription="drawing"
                    aria-label="The mechanism; tools have letters, arrow keys move the selection or the cursor, Enter places a point, question mark lists all keys" {}
                div id="hint" {}
                ul id="beside" aria-label="Problems of the drawing" {}
            }
            (player_html())
        }
    }
}

/// Returns the controls of the motion: the same parts as in the report.
fn player_html() -> Markup {
    html! {
        div.player id="player" role="group" aria-label="Motion" {
            button type="button" data-part="play" { "Play" }
            input type="range" data-part="range" min="0" max="0" step="1" value="0" aria-label="Position";
            label.check data-part="again" { input type="checkbox" data-part="loop" checked; " Loop" }
            button type="button" data-part="home" { "Back to the drawn pose" }
            button type="button" data-part="trace" aria-pressed="false" title="Then click a link to trace the path of that point" { "Trace" }
            button type="button" data-part="untrace" hidden { "No traces" }
            label.shown { "Shown " select data-part="shown" {} }
            span.unseen role="status" data-part="say" {}
        }
    }
}

fn side_html() -> Markup {
    html! {
        div id="side" {
            section id="verdict" aria-label="Verdict" {
                div id="states" role="tablist" aria-label="States" {}
                div id="verdict-panel" role="tabpanel" tabindex="0" aria-label="Verdict" {}
            }
            div id="work" role="status" {}
            section id="ideas" aria-label="Ideas" {}
            section id="thing" aria-label="Selection" hidden {}
            section id="search" aria-label="Search" hidden { details id="search-fold" {} }
            section id="curves" aria-label="Curves" hidden {}
            section id="force" aria-label="Forces" hidden {}
            section id="text-room" aria-label="The file as text" {
                div id="problems" {}
                details id="text-fold" {
                    summary { "The file" }
                    label { span.unseen { "Text of the file" } textarea id="text" spellcheck="false" autocomplete="off" wrap="off" rows="24" {} }
                }
            }
        }
    }
}
