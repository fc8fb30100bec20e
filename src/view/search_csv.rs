//! The variants of a search as CSV, one a line, a column for each joint that has a choice.

use crate::format::csv::encoded;
use crate::format::number::cost;
use crate::model::mechanism::JointId;
use crate::score::outcome::Outcome;
use crate::score::variant::Variant;
use crate::score::variants::Variants;
use crate::search::conditions::Search;
use crate::search::diagram::Stop;
use crate::search::over_stroke::OverStroke;
use crate::search::space::choice_name;
use itertools::Itertools;
use std::fmt::{self, Write as _};
use std::io::{self, Write};

/// Columns before the joints.
const FIGURES: [&str; 6] = [
    "position",
    "cost",
    "mobility",
    "redundant",
    "external_redundant",
    "changes",
];
/// Columns after them.
const OPINIONS: [&str; 3] = ["conditioning", "agree", "lucky"];
/// Columns at the end.
const MORE: [&str; 2] = ["external_harmful", "redundant_by_contour"];
/// Columns of a ranking.
const SCORES: [&str; 8] = [
    "by_cost",
    "peak_force",
    "peak_moment",
    "singular_ratio",
    "output_error",
    "idle",
    "total",
    "front",
];

/// Writes the variants as they come, and a comment at the end where they are not all that was asked for.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut dyn Write, outcome: &Outcome, mut variants: Variants<'_>) -> io::Result<()> {
    rows(out, outcome, &mut variants)?;
    if variants.stop() != Stop::Exhausted {
        let proven = match variants.summary().proven {
            Some(n) if n > 0 => format!(", the first {n} proven the cheapest"),
            _ => String::new(),
        };
        let (given, of) = (variants.summary().given, &outcome.admissible);
        let least = if outcome.is_exact() { "" } else { "at least " };
        let why = variants.stop().word();
        writeln!(
            out,
            "# stopped early ({why}): {given} of {least}{of} admissible variants given{proven}"
        )?;
    }
    Ok(())
}

fn rows(out: &mut dyn Write, outcome: &Outcome, variants: &mut Variants<'_>) -> io::Result<()> {
    let search = &outcome.search;
    let joints = columns(search);
    let mut heads: Vec<&str> = FIGURES.to_vec();
    let names = joints
        .iter()
        .map(|&(_, j)| search.mechanism.joints[j].id.as_str());
    heads.extend(names);
    heads.extend(OPINIONS);
    if outcome.ranking.is_some() {
        heads.extend(SCORES);
    }
    heads.extend(MORE);
    writeln!(out, "{}", heads.into_iter().map(encoded).join(","))?;
    // Most of a line is what was chosen, the same few words again and again.
    let chosen: Vec<(usize, Vec<String>)> = joints
        .iter()
        .map(|&(variable, j)| {
            let choices = search.space.variables[variable].choices.iter();
            let cell = |c| encoded(&choice_name(&search.mechanism, j, c));
            (variable, choices.map(cell).collect())
        })
        .collect();
    let mut line = String::new();
    for v in variants {
        line.clear();
        figures(&mut line, outcome, &chosen, &v).map_err(io::Error::other)?;
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// Writes the line of a variant; `chosen` are a column's variable and its cells, by choice.
fn figures(
    line: &mut String,
    outcome: &Outcome,
    chosen: &[(usize, Vec<String>)],
    v: &Variant<'_>,
) -> fmt::Result {
    write!(
        line,
        "{},{},{},{},{},{}",
        v.position(),
        cost(v.cost_milli()),
        v.mobility(),
        v.redundant(),
        told(v.external_redundant()),
        v.change_count()
    )?;
    let choices = &v.assignment().choices;
    for (variable, cells) in chosen {
        line.push(',');
        line.push_str(&cells[choices[*variable]]);
    }
    let opinion = v.second().opinion();
    write!(
        line,
        ",{},{},{}",
        told(opinion.map(|o| format!("{:e}", o.conditioning))),
        told(opinion.map(|o| o.agree)),
        told(v.over_stroke().and_then(OverStroke::lucky))
    )?;
    if outcome.ranking.is_some() {
        match v.ranked() {
            Some(r) => write!(
                line,
                ",{},{},{},{},{},{},{},{}",
                r.by_cost,
                r.scores.force.utilisation,
                r.scores.moment.utilisation,
                r.scores.conditioning,
                r.scores.output_error,
                r.scores.idle,
                told(r.total),
                told(r.front)
            )?,
            None => line.push_str(&",".repeat(SCORES.len())),
        }
    }
    writeln!(
        line,
        ",{},{}",
        told(v.external_harmful()),
        encoded(&contours(v))
    )
}

fn told<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |x| x.to_string())
}

/// "0-1-2-3: 1 (0 to 1); 0-1-6-7: 0 (0 to 1)": σ of the contours that may have any, in the order they are added in.
fn contours(v: &Variant<'_>) -> String {
    let shares = v.redundant_by_contour().into_iter().flatten();
    let some = shares.filter(|(_, s)| s.range.1 > 0);
    some.map(|(name, s)| format!("{name}: {} ({} to {})", s.redundant, s.range.0, s.range.1))
        .join("; ")
}

/// The joints that have a choice, in file order: (variable, joint).
fn columns(search: &Search) -> Vec<(usize, JointId)> {
    let variables = search.space.variables.iter().enumerate();
    let choosing = variables.filter(|(_, v)| v.choices.len() > 1);
    let mut out: Vec<_> = choosing
        .flat_map(|(v, variable)| variable.joints.iter().map(move |&j| (v, j)))
        .collect();
    out.sort_by_key(|&(_, j)| j);
    out
}
