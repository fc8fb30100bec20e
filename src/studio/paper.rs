//! The parts of the page: its frame, which the scripts fill, its scripts and its style. The report and the studio draw with the same scripts.

use crate::draw::SHEET_STYLE;
use crate::page::{LOOK, SHARED};

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

/// The frame of the page, which the scripts fill.
pub(super) const PAGE: &str = include_str!("page.html");

/// The picture of the window's tab.
pub(super) const ICON: &str = include_str!("icon.svg");

pub(super) fn whole_script() -> String {
    [SHARED.concat(), SCRIPTS.concat()].concat()
}

pub(super) fn whole_style() -> String {
    STYLES.concat()
}
