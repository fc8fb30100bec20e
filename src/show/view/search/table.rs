//! Variants as a table for people, and σ of their contours.

use crate::score::outcome::variant::{Variant, in_words};
use crate::search::check::singular_values::{NEARLY_SINGULAR, Opinion, Second};
use crate::view::prelude::*;
use crate::view::search::ranking;

/// Some variants as a table.
pub(crate) fn variants(outcome: &Outcome, best: &[Variant<'_>], width: Option<u16>) -> String {
    let ranking = outcome.ranking.as_ref();
    let checked = best.iter().any(|v| *v.second() != Second::Unasked);
    let counted = outcome.is_counted() || outcome.is_numeric_whole();
    let least = if counted { "" } else { "at least " };
    let rows = best.iter().map(|v| {
        let sigma = match v.external_redundant() {
            Some(external) => format!("{} + {external}", v.redundant()),
            None => v.redundant().to_string(),
        };
        let mut row = vec![
            format!("{}{}", v.position(), mark(v)),
            cost(v.cost_milli()),
            v.mobility().to_string(),
            sigma,
        ];
        row.extend(v.external_harmful().map(|n| n.to_string()));
        if checked {
            let of = |o: &Opinion| format!("{:.1e}", o.conditioning);
            row.push(v.second().opinion().map_or(String::new(), of));
        }
        if let Some(p) = ranking {
            let cells = v.ranked().map(|r| ranking::cells(p, r));
            row.extend(cells.unwrap_or_default());
        }
        row.extend(v.idea().map(|i| format!("{least}{}", grouped(&i.variants))));
        row.push(in_words(&outcome.search, &v.changes()));
        row
    });
    let distinct = outcome.request.distinct;
    let mut heads = vec![if distinct { "idea" } else { "" }, "cost", "W", "σ"];
    heads.extend(outcome.search.conditions.state.map(|_| "harmful"));
    heads.extend(checked.then_some("cond."));
    heads.extend(ranking.into_iter().flat_map(ranking::columns));
    heads.extend(distinct.then_some("stands for"));
    heads.push("changes");
    table(&heads.join(" | "), rows, width)
}

/// σ contour by contour of some variants, those alike together.
pub(crate) fn contours(best: &[Variant<'_>], width: Option<u16>) -> String {
    let mut alike: Vec<(String, Vec<usize>)> = Vec::new();
    for v in best {
        let shares = v.redundant_by_contour().into_iter().flatten();
        let some = shares.filter(|(_, s)| s.range.1 > 0).map(|(name, s)| {
            let range = match s.range {
                (a, b) if a == b => String::new(),
                (a, b) => format!(" ({a} to {b})"),
            };
            format!("{name} {}{range}", s.redundant)
        });
        let text = some.collect_vec().join(", ");
        match alike.iter_mut().find(|(known, _)| *known == text) {
            Some((_, places)) => places.push(v.position()),
            None => alike.push((text, vec![v.position()])),
        }
    }
    if let [(one, _)] = &alike[..]
        && one.is_empty()
    {
        return "\n  σ by contour: 0 in each, for any order of contours\n".to_owned();
    }
    let head =
        "\n  σ by contour, added in this order (range over all orders of these):\n".to_owned();
    let line = |(text, places): &(String, Vec<usize>)| {
        let text = if text.is_empty() { "none" } else { text };
        format!("  {}: {text}\n", runs(places))
    };
    fit(&alike.iter().map(line).fold(head, |all, l| all + &l), width)
}

/// "1, 3-5" for 1, 3, 4, 5.
fn runs(places: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &p in places {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == p => *last = p,
            _ => runs.push((p, p)),
        }
    }
    let one = |&(a, b): &(usize, usize)| {
        if a == b {
            a.to_string()
        } else {
            format!("{a}-{b}")
        }
    };
    runs.iter().map(one).join(", ")
}

/// The mark of a variant that a footnote tells about.
fn mark(v: &Variant<'_>) -> &'static str {
    match v.second() {
        Second::Failed => " ?",
        Second::Given(o) if !o.agree => " *",
        _ if v.lucky() => " !",
        Second::Unasked => "",
        Second::Given(o) if o.conditioning < NEARLY_SINGULAR => " ~",
        Second::Given(_) => "",
    }
}
