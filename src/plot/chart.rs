//! Charts as self-contained SVG: lines on linear or log axes, and a page that gathers them.
//!
//! The SVG is written by a helper in this crate. plotters and charts-rs fix the colours, so that one picture cannot be
//! both light and dark. poloto has no log axis. charming runs V8. None of them keeps names at line ends apart. The
//! `svg` crate puts spaces before superscripts and lets control characters through.
//!
//! Every picture has its own style sheet with a light and a dark look, and needs no script and no font file. It is byte for byte the same
//! for the same input. A point that cannot be shown is omitted and breaks its line. Such points are not finite, beyond 1e300 on a linear
//! axis, or not positive on a log axis.

pub use data::{Axis, Chart, Scale, Series, Style};
use maud::{PreEscaped, html};

mod axis;
mod data;
mod drawn;
mod frame;
mod line;

const STYLE: &str = include_str!("chart/page.css");

/// Returns one self-contained HTML page: under the title, each part with its heading, an SVG, which is written as it is given, and a
/// sentence. Pictures show their headings themselves, so those of the parts are for screen readers and the table of contents.
///
/// The page follows the reader's light or dark setting, prints on white, and on a narrow screen each picture scrolls by itself.
/// From four parts on there is a table of contents.
///
/// # Examples
/// ```
/// use ozols::chart::page;
/// let html = page("Results", &[("Growth".into(), "It is linear.".into(), "<svg></svg>".into())]);
/// assert!(html.starts_with("<!doctype html>") && html.contains("<svg></svg>"));
/// ```
pub fn page(title: &str, parts: &[(String, String, String)]) -> String {
    let page = html! {
        (PreEscaped("<!doctype html>\n"))
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { (title) }
                    @if parts.len() > 3 {
                        nav aria-label="Contents" {
                            ul {
                                @for (n, (heading, ..)) in parts.iter().enumerate() {
                                    li { a href={ "#part-" (n + 1) } { (heading) } }
                                }
                            }
                        }
                    }
                    @for (n, (heading, sentence, svg)) in parts.iter().enumerate() {
                        section id={ "part-" (n + 1) } {
                            h2 { (heading) }
                            // Reached by keyboard, since it scrolls.
                            @if !svg.is_empty() {
                                div.wide tabindex="0" role="group" aria-label=(heading) { (PreEscaped(svg)) }
                            }
                            @if !sentence.is_empty() { p { (sentence) } }
                        }
                    }
                }
            }
        }
        "\n"
    };
    page.into_string()
}

#[cfg(test)]
mod tests;
