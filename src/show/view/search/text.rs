//! A search for people.

use crate::robots::is_description;
use crate::score::outcome::listing::Variants;
use crate::score::outcome::remarks::Remarks;
use crate::search::check::singular_values::{NEARLY_SINGULAR, Opinion, Second, Summary};
use crate::view::prelude::*;
use crate::view::search::counts::counts_text;
use crate::view::search::nothing_found::{hopeless_reasons, wider_commands};
use crate::view::search::{counts, ranking, variant, why};
use crate::view::terminal::next_commands::{self, file_name};
use std::io;

/// Maximum number of variants of a table.
const BLOCK: usize = 1000;

/// Writes an outcome with its variants as they come, the remarks, and what to do next. `file` is the argument that named the mechanism.
/// With `verbose` it also writes the counts by mobility, σ by contour, and what each of the first ideas does.
///
/// # Errors
/// Those of the writer.
///
/// # Examples
/// ```
/// use ozols::{score::outcome::remarks::Remarks, view::search::text::write_text};
/// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
/// let mut text = Vec::new();
/// let (variants, remarks) = (outcome.variants(), Remarks::default());
/// write_text(&mut text, &outcome, variants, &remarks, "gripper-10", None, false)?;
/// assert!(String::from_utf8(text)?.contains("21,817,629"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_text(
    out: &mut dyn io::Write,
    outcome: &Outcome,
    mut given: Variants<'_>,
    remarks: &Remarks,
    file: &str,
    width: Option<u16>,
    verbose: bool,
) -> io::Result<()> {
    write!(out, "{}", counts_text(outcome, width, verbose))?;
    let why = hopeless_reasons(&outcome.search.mechanism, &remarks.hopeless).into_iter();
    let why: String = why.map(|line| format!("  {line}\n")).collect();
    write!(out, "{}", fit_lines(&why, width))?;
    let sample = matches!(outcome.request.list, List::Sample(_));
    let what = list_order(outcome);
    let (mut footnotes, mut changed) = (Vec::new(), false);
    // A table is laid out as a whole, so a long list is given as several.
    loop {
        let block = given.by_ref().take(BLOCK).collect_vec();
        let Some(first) = block.first() else { break };
        if first.position() == 1 {
            changed = first.cost_milli() > 0;
            write!(out, "{}", fit_lines(&format!("\n  {what}:\n"), width))?;
        }
        writeln!(out, "{}", variants_table(outcome, &block, width))?;
        // Shares of contours are found in exact arithmetic.
        if outcome.numeric.is_none() && (verbose || block.iter().any(is_redundant)) {
            write!(out, "{}", contours_text(&block, width))?;
        }
        if outcome.request.distinct && first.position() == 1 {
            let told = if verbose { why::TOLD } else { 1 };
            let shown = block.iter().take(told).map(Variant::assignment);
            let shown = shown.collect_vec();
            write!(out, "{}", fit_lines(&why::why_text(outcome, &shown), width))?;
        }
        footnotes.extend(block.iter().filter_map(variant_footnote));
    }
    if let Some(symmetric) = &remarks.symmetric {
        write!(
            out,
            "{}",
            fit_lines(&variant::symmetric_text(symmetric), width)
        )?;
    }
    let summary = given.summary();
    write_notes(out, &summary, footnotes, width)?;
    if let Some(p) = &outcome.ranking {
        let m = &outcome.search.mechanism;
        let lines = ranking::ranking_notes(m, p).into_iter();
        let notes = lines
            .chain(ranking::place_reasons(m, p))
            .map(|l| format!("\n  {l}"));
        writeln!(out, "{}", fit_lines(&notes.collect::<String>(), width))?;
    }
    if let Some(stop) = given.cut_short() {
        let (why, given) = (stop.word(), count_noun(summary.given, "variant"));
        writeln!(out, "\n  stopped early ({why}) after {given}")?;
    }
    // Numbers of a sample, or of a list with some left out, mean nothing to other commands.
    let undecided = summary.given == 0 && outcome.admissible_may_be_more();
    let steps = if undecided {
        Vec::new()
    } else {
        let given = if sample { 0 } else { summary.given };
        if given > 0 {
            next_of_some(outcome, changed, file, verbose)
        } else {
            next_of_none(outcome, remarks, file)
        }
    };
    write!(out, "{}", next_commands::steps_text(&steps, width))
}

/// Returns whether a variant leaves redundant constraints.
fn is_redundant(v: &Variant<'_>) -> bool {
    v.redundant() > 0 || v.external_redundant().is_some_and(|n| n > 0)
}

/// Returns the order of the variants in words.
fn list_order(outcome: &Outcome) -> String {
    match &outcome.ranking {
        Some(p) => ranking::ranking_head(p),
        None if matches!(outcome.request.list, List::Sample(_)) => "drawn at random".to_owned(),
        None if outcome.request.distinct => counts::IDEAS.to_owned(),
        None => "cheapest first".to_owned(),
    }
}

/// Writes the remarks on the whole list, then the footnotes.
fn write_notes(
    out: &mut dyn io::Write,
    summary: &Summary,
    footnotes: Vec<String>,
    width: Option<u16>,
) -> io::Result<()> {
    let lines = summary_notes(summary).into_iter();
    let notes = lines
        .chain(limit_footnotes(footnotes))
        .map(|l| format!("  {l}\n"));
    let gap = if summary.is_asked() || summary.proven.is_some_and(|n| n > 0) {
        "\n"
    } else {
        ""
    };
    write!(out, "{gap}{}", fit_lines(&notes.collect::<String>(), width))
}

/// Returns the footnote of a marked variant.
pub(crate) fn variant_footnote(v: &Variant<'_>) -> Option<String> {
    let position = v.position();
    if let Some((f, present)) = v.over_stroke().and_then(|s| s.other) {
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
    match v.second() {
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

/// Maximum number of footnotes.
const NOTES: usize = 20;

/// Returns the findings of second opinions and other poses, one per line.
pub(crate) fn summary_notes(summary: &Summary) -> Vec<String> {
    let mut out = Vec::new();
    if summary.is_asked() {
        out.push(opinions_line(summary));
    }
    out.extend(counts::proven_line(summary));
    let posed = group_thousands(summary.posed);
    match (summary.posed, summary.lucky) {
        (0, _) => {}
        (_, 0) => out.push(format!("Same figures in other poses: all {posed}")),
        (_, n) => out.push(format!(
            "Other figures in other poses: {n} of {posed}, marked !"
        )),
    }
    out
}

/// Returns the notes of marked variants. If there are many, returns the first of them.
fn limit_footnotes(mut notes: Vec<String>) -> Vec<String> {
    let more = notes.len().saturating_sub(NOTES);
    notes.truncate(NOTES);
    if more > 0 {
        notes.push(format!("and {more} more marked"));
    }
    notes
}

/// Returns the commands to suggest after a search that found variants. `file` is the search's own, as
/// are the flags, so that the commands are about the same list.
fn next_of_some(outcome: &Outcome, changed: bool, file: &str, verbose: bool) -> Vec<NextCommand> {
    let flags = &request_flags(outcome);
    let number = outcome.request.noun_of_one();
    let one = &typed_option(number, 1);
    let joined = |more: &str| format!("{flags} {more}").trim().to_owned();
    let mechanism = &outcome.search.mechanism.name;
    let svg = file_name(&format!("{mechanism}-{number}-1"), "svg");
    let toml = file_name(&format!("{mechanism}-{number}-1"), "toml");
    // Whose first variant changes nothing has nothing to mend.
    let own = (changed && is_description(file)).then(|| {
        NextCommand::fix_command(file, &joined(one), &format!("{number} 1 in your own file"))
    });
    let steps = [
        NextCommand::new(
            "draw",
            file,
            &joined(&format!("{one} -o {svg}")),
            &format!("{number} 1 as a drawing, changes in colour"),
        ),
        NextCommand::new(
            "export",
            file,
            &joined(&format!("{one} {} -o {toml}", typed_option("to", "toml"))),
            &format!("{number} 1 as a separate mechanism file"),
        ),
    ];
    let more = (!verbose).then(|| {
        let gives = "counts by mobility, and what each of the first three does";
        NextCommand::new("search", file, &joined(&typed_option("verbose", "")), gives)
    });
    own.into_iter().chain(steps).chain(more).collect()
}

/// Returns the options of a search request. `--idea` means ideas.
fn request_flags(outcome: &Outcome) -> String {
    let request = Request {
        distinct: false,
        ..outcome.request.clone()
    };
    next_commands::request_flags(&outcome.search.mechanism, &request)
}

/// Returns what to do next where no variant is given: ask for some, or ease a condition.
fn next_of_none(outcome: &Outcome, remarks: &Remarks, file: &str) -> Vec<NextCommand> {
    if outcome.listed_counts().total.is_zero() {
        return wider_commands(outcome, remarks, "search", file);
    }
    vec![NextCommand::new(
        "search",
        file,
        format!("{} {}", request_flags(outcome), typed_option("top", 10)).trim(),
        "the cheapest of them",
    )]
}

fn opinions_line(summary: &Summary) -> String {
    let asked = group_thousands(summary.checked + summary.failed);
    let which = if summary.given > summary.checked + summary.failed {
        format!("the first {asked}; the rest was not asked about")
    } else {
        format!("all {asked}")
    };
    let wrong = summary.disagreeing + summary.failed;
    let verdict = match (wrong, &*asked) {
        (0, "1") => "Singular values agree".to_owned(),
        (1, "1") => "Singular values disagree".to_owned(),
        (0, _) => format!("Singular values agree on {which}"),
        _ => format!(
            "Singular values disagree on {wrong} of {}",
            which.trim_start_matches("all ")
        ),
    };
    format!("{verdict} (cond. = smallest / largest)")
}

/// Returns some variants as a table.
pub(crate) fn variants_table(
    outcome: &Outcome,
    best: &[Variant<'_>],
    width: Option<u16>,
) -> String {
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
            format!("{}{}", v.position(), variant_mark(v)),
            format_cost(v.cost_milli()),
            v.mobility().to_string(),
            sigma,
        ];
        row.extend(v.external_harmful().map(|n| n.to_string()));
        if checked {
            let of = |o: &Opinion| format!("{:.1e}", o.conditioning);
            row.push(v.second().opinion().map_or(String::new(), of));
        }
        if let Some(p) = ranking {
            let cells = v.ranked().map(|r| ranking::ranking_cells(p, r));
            row.extend(cells.unwrap_or_default());
        }
        row.extend(
            v.idea()
                .map(|i| format!("{least}{}", group_thousands(&i.variants))),
        );
        row.push(in_words(&outcome.search, &v.list_changes()));
        row
    });
    let distinct = outcome.request.distinct;
    let mut heads = vec![if distinct { "idea" } else { "" }, "cost", "W", "σ"];
    heads.extend(outcome.search.conditions.state.map(|_| "harmful"));
    heads.extend(checked.then_some("cond."));
    heads.extend(ranking.into_iter().flat_map(ranking::ranking_columns));
    heads.extend(distinct.then_some("stands for"));
    heads.push("changes");
    text_table(&heads.join(" | "), rows, width)
}

/// Returns σ by contour of some variants; equal ones share a line.
pub(crate) fn contours_text(best: &[Variant<'_>], width: Option<u16>) -> String {
    let alike = group_by_key(best.iter().map(|v| {
        let shares = v.redundant_by_contour().into_iter().flatten();
        let some = shares.filter(|(_, s)| s.range.1 > 0).map(|(name, s)| {
            let range = match s.range {
                (a, b) if a == b => String::new(),
                (a, b) => format!(" ({a} to {b})"),
            };
            format!("{name} {}{range}", s.redundant)
        });
        (some.collect_vec().join(", "), v.position())
    }));
    if let [(one, _)] = &alike[..]
        && one.is_empty()
    {
        return "\n  No loop has a redundant constraint left, in any order of loops\n".to_owned();
    }
    let head =
        "\n  Redundant constraints left in each loop, in this order of loops (range over all orders):\n".to_owned();
    let line = |(text, places): &(String, Vec<usize>)| {
        let text = if text.is_empty() { "none" } else { text };
        format!("  {}: {text}\n", format_runs(places))
    };
    fit_lines(&alike.iter().map(line).fold(head, |all, l| all + &l), width)
}

/// Formats places: "1, 3-5" for 1, 3, 4, 5.
fn format_runs(places: &[usize]) -> String {
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

/// Returns the mark of a variant with a footnote.
fn variant_mark(v: &Variant<'_>) -> &'static str {
    match v.second() {
        Second::Failed => " ?",
        Second::Given(o) if !o.agree => " *",
        _ if v.is_lucky() => " !",
        Second::Unasked => "",
        Second::Given(o) if o.conditioning < NEARLY_SINGULAR => " ~",
        Second::Given(_) => "",
    }
}
