//! How sure the figures of a page are: the same words as those of `analyze` and `search`.

use super::embed::text;
use super::{Page, Redesigns};
use crate::search::primes::Verdict;
use crate::view::search_text;
use itertools::Itertools;

pub(super) fn html(page: &Page<'_>) -> String {
    let mut out = String::from("<dl class=\"facts\">\n");
    let several = page.states.len() > 1;
    for s in page.states {
        let head = if several {
            format!("State {}", s.state)
        } else {
            "The mechanism".to_owned()
        };
        let mut lines = vec![s.certainty.describe()];
        lines.extend(s.choice.iter().map(|c| format!("method: {c}")));
        lines.push(format!(
            "finite mobility {}: {}",
            s.finite.figure(),
            s.finite.describe()
        ));
        lines.extend(s.snapped.iter().map(|m| format!("snapped: {m}")));
        if let Some(rank) = s.as_written {
            lines.push(format!(
                "as written, every digit at its word: mobility {}, σ = {}",
                s.freedoms - rank,
                s.rows - rank
            ));
        }
        for (j, n) in &s.left_out {
            let joint = &page.mechanism.joints[*j].id;
            lines.push(format!("left out in the plane: {n} of joint {joint}"));
        }
        out += &row(&head, &lines);
    }
    if let Ok(r) = &page.redesigns {
        out += &row("The search", &search(r));
    }
    out + "</dl>\n"
}

fn row(head: &str, lines: &[String]) -> String {
    let lines = lines.iter().map(|l| text(l)).join("<br>\n");
    format!("<dt>{}</dt><dd>{lines}</dd>\n", text(head))
}

fn search(r: &Redesigns<'_>) -> Vec<String> {
    let found = r.found;
    let mut lines = Vec::new();
    match found.check {
        Some(([p, q], Verdict::Agree)) => {
            lines.push(format!("Checked: modulo {p} and {q} the same"));
        }
        Some((_, Verdict::Interrupted)) => {
            lines.push("Not checked by a second prime: interrupted".to_owned());
        }
        None => lines.push("One prime, without a second opinion".to_owned()),
    }
    if found.stop == "exhausted" {
        lines.push("Every variant was counted; none was left out".to_owned());
    } else {
        lines.push(format!(
            "Stopped early ({}): counts are lower bounds, variants are valid but may not be the cheapest",
            found.stop
        ));
    }
    if let Some((why, verdicts)) = &found.measured {
        let agree = verdicts.iter().all(|v| v.agree());
        lines.push(format!(
            "The coordinates look measured ({why}); exact and tolerant ranks {} on the mechanism as it is, and the search \
             takes every digit at its word",
            if agree { "agree" } else { "differ" }
        ));
    }
    let notes = search_text::notes(&r.summary, &[], None);
    lines.extend(notes.lines().map(|l| l.trim().to_owned()));
    if r.interrupted {
        lines.push(format!("Interrupted after {} variants", r.variants.len()));
    }
    lines.retain(|l| !l.is_empty());
    lines
}
