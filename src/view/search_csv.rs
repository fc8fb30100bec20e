//! The variants of a search as CSV, one a line, a column for each joint that has a choice.

use crate::format::csv::cell;
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
    let mut out = csv::Writer::from_writer(out);
    let search = &outcome.search;
    let joints = columns(search);
    let mut row: Vec<String> = FIGURES.map(str::to_owned).to_vec();
    row.extend(
        joints
            .iter()
            .map(|&(_, j)| cell(&search.mechanism.joints[j].id).into_owned()),
    );
    row.extend(OPINIONS.map(str::to_owned));
    if outcome.ranking.is_some() {
        row.extend(SCORES.map(str::to_owned));
    }
    row.extend(MORE.map(str::to_owned));
    out.write_record(&row).map_err(of_writer)?;
    for v in variants {
        row.clear();
        row.extend([
            v.position().to_string(),
            cost(v.cost_milli()),
            v.mobility().to_string(),
            v.redundant().to_string(),
            told(v.external_redundant()),
            v.change_count().to_string(),
        ]);
        let choices = &v.assignment().choices;
        row.extend(joints.iter().map(|&(variable, j)| {
            let choice = &search.space.variables[variable].choices[choices[variable]];
            cell(&choice_name(&search.mechanism, j, choice)).into_owned()
        }));
        let opinion = v.second().opinion();
        row.extend([
            told(opinion.map(|o| format!("{:e}", o.conditioning))),
            told(opinion.map(|o| o.agree)),
            told(v.over_stroke().and_then(OverStroke::lucky)),
        ]);
        if outcome.ranking.is_some() {
            row.extend(match v.ranked() {
                Some(r) => [
                    r.by_cost.to_string(),
                    r.scores.force.utilisation.to_string(),
                    r.scores.moment.utilisation.to_string(),
                    r.scores.conditioning.to_string(),
                    r.scores.output_error.to_string(),
                    r.scores.idle.to_string(),
                    told(r.total),
                    told(r.front),
                ],
                None => Default::default(),
            });
        }
        row.extend([told(v.external_harmful()), cell(&contours(&v)).into_owned()]);
        out.write_record(&row).map_err(of_writer)?;
    }
    out.flush()
}

/// The writer's own error, by which a closed pipe is known.
fn of_writer(e: csv::Error) -> io::Error {
    match e.into_kind() {
        csv::ErrorKind::Io(e) => e,
        other => io::Error::other(format!("{other:?}")),
    }
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
