//! A search for people.

use crate::format::number::{cost, grouped};
use crate::search::best::Variant;
use crate::search::certify::{Certified, NEARLY_SINGULAR, Second, Summary};
use crate::search::primes::Verdict;
use crate::search::relax::Relaxation;
use crate::search::request::Search;
use crate::view::layout::{fit, table};
use crate::view::next::{Step, file_name};
use crate::view::ranking;
use crate::view::search_json::{self, Found};
use itertools::Itertools;
use num_traits::Zero;
use std::collections::BTreeSet;
use std::fmt::Write;

/// The verdict, how it was checked, and the counts by mobility.
#[must_use]
pub fn counts(found: &Found<'_>, width: Option<u16>) -> String {
    let mut out = String::new();
    let big = |n: &num_bigint::BigUint| grouped(&n.to_string());
    let (least, request) = (
        if found.stop == "exhausted" {
            ""
        } else {
            "at least "
        },
        &found.search.request,
    );
    let condition = if request.max_redundant == 0 {
        "σ = 0".to_owned()
    } else {
        format!("σ ≤ {}", request.max_redundant)
    };
    let (mechanism, size) = (&found.search.mechanism.name, found.search.size());
    let more = [
        request
            .keep_output
            .then_some("keep the output motion".to_owned()),
        request.max_mobility.map(|w| format!("have W ≤ {w}")),
        request
            .max_changes
            .map(|c| format!("change at most {c} joints")),
        request.state.map(|(s, e)| {
            format!(
                "have external σ ≤ {e} in state {}",
                found.search.mechanism.states[s]
            )
        }),
    ];
    let more: Vec<String> = more.into_iter().flatten().collect();
    let all = match more.split_last() {
        None => format!("have {condition}"),
        Some((last, rest)) => {
            let head = std::iter::once(format!("have {condition}")).chain(rest.iter().cloned());
            format!("{} and {last}", head.collect_vec().join(", "))
        }
    };
    let good = if found.admissible.total.is_zero() && least.is_empty() {
        "none".to_owned()
    } else {
        format!("{least}{}", big(&found.admissible.total))
    };
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{mechanism}: {good} of {} variants {all}", big(&size));
    if size == num_bigint::BigUint::from(1u8) {
        let _ = writeln!(
            out,
            "  no joint has a choice: list some under [search], such as options = [\"revolute\", \"spherical\"]"
        );
    }
    if !more.is_empty() {
        let _ = writeln!(
            out,
            "  {least}{} with {condition}, whatever else they do",
            big(&found.determinate.total)
        );
    }
    if let Some(([p, q], verdict)) = found.check {
        let _ = match verdict {
            Verdict::Agree => writeln!(out, "  Checked: modulo {p} and {q} the same"),
            Verdict::Interrupted => writeln!(out, "  Not checked by a second prime: interrupted"),
        };
    }
    if found.stop != "exhausted" {
        let _ = writeln!(
            out,
            "  Stopped early ({}): counts are lower bounds, variants are valid but may not be the cheapest",
            found.stop
        );
    }
    let mobilities: BTreeSet<i64> = found
        .determinate
        .by_mobility
        .keys()
        .chain(found.admissible.by_mobility.keys())
        .copied()
        .collect();
    // Mobilities that no admissible variant has are of no use to a designer.
    let shown = mobilities.iter().filter(|w| {
        found.admissible.total.is_zero() || found.admissible.by_mobility.contains_key(w)
    });
    let rows = shown.map(|w| {
        let of = |m: &std::collections::BTreeMap<i64, num_bigint::BigUint>| {
            m.get(w).map_or("0".into(), big)
        };
        vec![
            w.to_string(),
            of(&found.determinate.by_mobility),
            of(&found.admissible.by_mobility),
        ]
    });
    if !mobilities.is_empty() {
        let _ = writeln!(
            out,
            "\n{}",
            table(&["W", &condition, "admissible"], rows.collect(), width)
        );
    }
    fit(&out, width)
}

/// Some variants, numbered on from `first`.
#[must_use]
pub fn variants(found: &Found<'_>, best: &[Certified], first: usize, width: Option<u16>) -> String {
    let search = found.search;
    let ranking = found.ranking.as_ref();
    let checked = best.iter().any(|v| v.second != Second::Unasked);
    let rows = best.iter().enumerate().map(|(i, certified)| {
        let v = &certified.variant;
        let sigma = match search.request.state {
            Some(_) => format!("{} + {}", v.key.internal(), v.key.external()),
            None => v.key.internal().to_string(),
        };
        let mut row = vec![
            format!("{}{}", i + first, mark(certified)),
            cost(search.steps.milli(v.key.cost())),
            search.mobility(v.key).to_string(),
            sigma,
        ];
        if checked {
            let of = |o: &crate::search::certify::Opinion| format!("{:.1e}", o.conditioning);
            row.push(certified.second.opinion().map_or(String::new(), of));
        }
        if let Some(p) = ranking {
            let cells = p.of(v).map(|(_, r)| ranking::cells(p, r));
            row.extend(cells.unwrap_or_default());
        }
        row.push(changes(search, v));
        row
    });
    let mut head = vec!["", "cost", "W", "σ"];
    head.extend(checked.then_some("cond."));
    head.extend(ranking.into_iter().flat_map(ranking::columns));
    head.push("changes");
    table(&head, rows.collect(), width)
}

/// The changes of a variant in words: "3-0, 7-0 -> spherical; 5-1 -> cylindrical".
#[must_use]
pub fn changes(search: &Search<'_>, variant: &Variant) -> String {
    let mut changed: Vec<(String, Vec<String>)> = Vec::new();
    for (joint, _, to) in search_json::changes(search, variant) {
        match changed.iter_mut().find(|(t, _)| *t == to) {
            Some((_, joints)) => joints.push(joint),
            None => changed.push((to, vec![joint])),
        }
    }
    if changed.is_empty() {
        return "none: the mechanism as it is".to_owned();
    }
    changed
        .iter()
        .map(|(to, joints)| format!("{} -> {to}", joints.join(", ")))
        .join("; ")
}

/// The mark of a variant that a footnote tells about.
fn mark(certified: &Certified) -> &'static str {
    match &certified.second {
        Second::Failed => " ?",
        Second::Given(o) if !o.agree => " *",
        _ if certified.lucky() => " !",
        Second::Unasked => "",
        Second::Given(o) if o.conditioning < NEARLY_SINGULAR => " ~",
        Second::Given(_) => "",
    }
}

/// The footnote of a marked variant.
#[must_use]
pub fn note(certified: &Certified, position: usize) -> Option<String> {
    if let Some((f, present)) = certified.stroke.and_then(|s| s.other) {
        let output = match (f.output, present) {
            (Some(o), Some(p)) if o != p => {
                format!(", and outputs that move in {o} ways instead of {p}")
            }
            _ => String::new(),
        };
        return Some(format!(
            "! {position}: in this pose only; another has W = {}, σ = {}{output}",
            f.mobility, f.redundant
        ));
    }
    match &certified.second {
        Second::Unasked => None,
        Second::Failed => Some(format!(
            "? {position}: the singular values did not converge"
        )),
        Second::Given(o) if !o.agree => {
            let external = o.external.map_or(String::new(), |e| format!(" + {e}"));
            let output = o
                .output
                .map_or(String::new(), |m| format!(", output mobility {m}"));
            Some(format!(
                "* {position}: by singular values W = {}, σ = {}{external}{output} (smallest kept {:.1e}, largest \
                 dropped {:.1e}); do not trust either without a look at the geometry",
                o.mobility, o.redundant, o.conditioning, o.dropped
            ))
        }
        Second::Given(o) if o.conditioning < NEARLY_SINGULAR => Some(format!(
            "~ {position}: nearly singular, smallest singular value {:.1e} of the largest: small errors of manufacture \
             may change its figures",
            o.conditioning
        )),
        Second::Given(_) => None,
    }
}

/// Footnotes told at most.
const NOTES: usize = 20;

/// What the singular values say of a list, with its footnotes.
#[must_use]
pub fn notes(summary: &Summary, notes: &[String], width: Option<u16>) -> String {
    let mut out = String::new();
    if summary.checked + summary.failed > 0 {
        opinions(&mut out, summary);
    }
    let posed = grouped(&summary.posed.to_string());
    // Writing to a string cannot fail.
    let _ = match (summary.posed, summary.lucky, summary.dropped) {
        (0, _, 0) => Ok(()),
        (_, _, n) if n > 0 => writeln!(
            out,
            "  {n} left out: their figures are not the same at other poses"
        ),
        (_, 0, _) => writeln!(out, "  Figures the same at other poses: all {posed}"),
        (_, n, _) => writeln!(
            out,
            "  Figures not the same at other poses: {n} of {posed}, marked !"
        ),
    };
    for n in notes.iter().take(NOTES) {
        let _ = writeln!(out, "  {n}");
    }
    if notes.len() > NOTES {
        let _ = writeln!(out, "  and {} more marked", notes.len() - NOTES);
    }
    fit(&out, width)
}

/// What to do after a search: look at the first variant given, or ease a condition. `file` and `flags` are the search's
/// own, so that the commands are about the same list.
#[must_use]
pub fn next(
    found: &Found<'_>,
    given: usize,
    eased: &[(Relaxation, num_bigint::BigUint)],
    file: &str,
    flags: &str,
) -> Vec<Step> {
    let joined = |more: &str| format!("{flags} {more}").trim().to_owned();
    let name = &found.search.mechanism.name;
    if given > 0 {
        let svg = file_name(&format!("{name}-variant-1"), "svg");
        let toml = file_name(&format!("{name}-variant-1"), "toml");
        return vec![
            Step::new(
                "draw",
                file,
                &joined(&format!("--variant 1 -o {svg}")),
                "the first of the list, its changes in colour",
            ),
            Step::new(
                "export",
                file,
                &joined(&format!("--variant 1 --to toml -o {toml}")),
                "the first of the list as a mechanism file of its own",
            ),
        ];
    }
    if !found.admissible.total.is_zero() {
        return vec![Step::new(
            "search",
            file,
            &joined("--top 10"),
            "the cheapest of them",
        )];
    }
    let steps = eased.iter().map(|(how, n)| {
        let flag = match how {
            Relaxation::Redundant(n) => format!("--max-redundant {n}"),
            Relaxation::External(n) => format!("--max-external {n}"),
            Relaxation::Mobility(n) => format!("--max-mobility {n}"),
            Relaxation::Changes(n) => format!("--max-changes {n}"),
            Relaxation::OutputChange => "--allow-output-change".to_owned(),
        };
        let n = grouped(&n.to_string());
        let least = if *how == Relaxation::OutputChange {
            format!("{n} variants, whose outputs move in other ways than now")
        } else {
            format!("{n} variants; no smaller number leaves any")
        };
        // The flag replaces the one that was given.
        let kept = without(flags, flag.split(' ').next().unwrap_or(""));
        Step::new("search", file, format!("{kept} {flag}").trim(), &least)
    });
    let options = Step {
        command: "Offer more options under [search], or at the joints".to_owned(),
        gives: "the search chooses from those in the file alone".to_owned(),
    };
    steps.chain([options]).collect()
}

/// Some flags without one of them and its value.
fn without(flags: &str, flag: &str) -> String {
    let mut words = flags.split(' ').peekable();
    let mut kept = Vec::new();
    while let Some(w) = words.next() {
        if w == flag {
            words.next_if(|v| !v.starts_with("--"));
        } else {
            kept.push(w);
        }
    }
    kept.join(" ")
}

fn opinions(out: &mut String, summary: &Summary) {
    let asked = grouped(&(summary.checked + summary.failed).to_string());
    let which = if summary.given > summary.checked + summary.failed {
        format!("the first {asked}; the rest was not asked about")
    } else {
        format!("all {asked}")
    };
    let wrong = summary.disagreeing + summary.failed;
    let verdict = if wrong == 0 {
        format!("Singular values agree on {which}")
    } else {
        format!(
            "Singular values disagree on {wrong} of {}",
            which.trim_start_matches("all ")
        )
    };
    // Writing to a string cannot fail.
    let _ = writeln!(out, "\n  {verdict} (cond.: the smallest over the largest)");
}
