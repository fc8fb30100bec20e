//! One HTML page for several pictures.

use maud::{PreEscaped, html};

const STYLE: &str = include_str!("page.css");

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
