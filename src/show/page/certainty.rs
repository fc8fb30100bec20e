//! How sure the figures of a page are: the same words as those of `analyze` and `search`.

use super::contents::{Page, Redesigns};
use crate::format::count_noun;
use crate::view::analysis::{Analysis, State};
use crate::view::search::{counts, text};
use maud::{Markup, html};

pub(super) fn certainty_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    let head = |s: &State<'_>| match analysis.states.len() {
        1 => "The mechanism".to_owned(),
        _ => format!("State {}", s.found.state),
    };
    html! {
        dl.facts {
            @for s in &analysis.states { (fact_row(&head(s), &state_lines(s))) }
            @if let Ok(r) = &page.redesigns { (fact_row("The search", &search_lines(r))) }
        }
    }
}

fn fact_row(head: &str, lines: &[String]) -> Markup {
    html! {
        dt { (head) }
        dd {
            @if let Some((first, rest)) = lines.split_first() {
                (first)
                @if !rest.is_empty() {
                    details {
                        summary { "Methods and checks" }
                        @for (i, line) in rest.iter().enumerate() {
                            @if i > 0 { br; "\n" }
                            (line)
                        }
                    }
                }
            }
        }
    }
}

fn state_lines(s: &State<'_>) -> Vec<String> {
    let mut lines = vec![s.certainty()];
    lines.extend(s.method_lines());
    lines.push(s.describe_finite());
    lines.extend(s.left_out());
    lines
}

fn search_lines(r: &Redesigns<'_>) -> Vec<String> {
    let found = r.found;
    let mut lines = counts::certainty_lines(found);
    if let Some((why, verdicts)) = &found.measured {
        let written = verdicts.iter().all(|v| v.is_as_written());
        let searched = if written {
            "exact and tolerant ranks agree on the original mechanism, and the search takes every digit exactly as written"
        } else if found.request.as_written {
            "something else is meant, and the search takes every digit exactly as written, as requested"
        } else {
            "the search uses the idealised geometry (snapped within the rounding of the file)"
        };
        lines.push(format!("The coordinates look rounded ({why}); {searched}"));
    }
    lines.extend(text::summary_notes(&r.summary));
    lines.extend(
        found
            .check
            .map(|c| format!("Primes: {} and {}", c.primes[0], c.primes[1])),
    );
    if r.interrupted {
        lines.push(format!(
            "Interrupted after {}",
            count_noun(r.variants.len(), "variant")
        ));
    }
    lines
}
