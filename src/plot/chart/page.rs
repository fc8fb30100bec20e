//! One HTML page for several pictures.

use maud::{PreEscaped, html};

const STYLE: &str = "
:root{color-scheme:light dark;--ink:#1c2126;--soft:#59636e;--back:#fff;--rule:#e3e7eb;--link:#0b4a83}
@media screen and (prefers-color-scheme:dark){
:root{--ink:#e8ebee;--soft:#a3adb7;--back:#15191d;--rule:#2b3239;--link:#8cc4f5}
}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0 auto;padding:2rem 1.25rem 4rem;max-width:66rem;color:var(--ink);background:var(--back);
font:1rem/1.5 system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif}
h1{font-size:1.75rem;line-height:1.2;margin:0 0 1rem}
h2{position:absolute;width:1px;height:1px;margin:0;overflow:hidden;clip-path:inset(50%)}
p{margin:0 0 1rem;max-width:42rem;color:var(--soft)}
a{color:var(--link)}
nav ul{margin:0;padding:0;list-style:none;columns:18rem;column-gap:2rem}
section{margin-top:2rem;padding-top:1.5rem;border-top:1px solid var(--rule);scroll-margin-top:1rem}
.wide{overflow-x:auto;margin:0 -1.25rem}
.wide p{margin:0 1.25rem 1rem}
.wide svg{display:block;height:auto;max-width:max(100%,36rem)}
@media print{
@page{margin:15mm}
body{padding:0;max-width:none;font-size:10pt}
nav{display:none}
.wide{break-after:avoid}
.wide{overflow:visible;margin:0 -5mm}
.wide svg{max-width:100%}
}
";

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
