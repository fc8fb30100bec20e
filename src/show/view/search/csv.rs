//! The variants of a search as CSV, one a line, a column for each joint that has a choice.

use crate::format::csv::encode_cell;
use crate::model::ranking::Term;
use crate::score::outcome::listing::Variants;
use crate::search::check::other_poses::OverStroke;
use crate::search::question::space::choice_name;
use crate::view::prelude::*;
use crate::view::search::{numeric, second_opinion};
use std::io::{self, Write};
use std::iter;

/// Columns before the joints.
const FIGURES: &str = "position,cost,mobility,redundant,external_redundant,changes";
/// Columns after them.
const OPINIONS: [&str; 3] = ["conditioning", "agree", "lucky"];
/// Columns at the end.
const MORE: [&str; 2] = ["external_harmful", "redundant_by_contour"];
/// Returns the column heads of a ranking.
fn score_heads() -> Vec<String> {
    let terms = Term::ALL.map(Term::about).into_iter().filter(|a| a.csv);
    let terms = terms.map(|a| a.key.replace('-', "_"));
    let first = iter::once("by_cost".to_owned());
    first.chain(terms).chain(["total".to_owned()]).collect()
}

/// Writes the variants as they come, and gives what there is to say where they are not all that was asked for.
///
/// # Errors
/// Those of the writer.
///
/// # Examples
/// ```
/// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
/// let mut csv = Vec::new();
/// ozols::view::search::csv::write_csv(&mut csv, &outcome, outcome.variants())?;
/// let csv = String::from_utf8(csv)?;
/// assert!(csv.starts_with("position,cost,mobility,redundant") && csv.lines().count() == 11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_csv(
    out: &mut dyn Write,
    outcome: &Outcome,
    mut variants: Variants<'_>,
) -> io::Result<Option<String>> {
    write_rows(out, outcome, &mut variants)?;
    if let Some(found) = &outcome.numeric {
        let all = numeric::from_to(&found.admissible);
        let lines = numeric::numeric_lines(outcome).join("; ");
        return Ok(Some(format!("numeric: {all} admissible variants. {lines}")));
    }
    if !outcome.is_confirmed() {
        let lines = second_opinion::opinion_lines(outcome).join("; ");
        return Ok(Some(format!(
            "not exact: {} admissible variants. {lines}",
            outcome.listed_counts()
        )));
    }
    if variants.stop() == Stop::Exhausted {
        return Ok(None);
    }
    let proven = match variants.summary().proven {
        Some(n) if n > 0 => format!(", the first {n} proven the cheapest"),
        _ => String::new(),
    };
    let (given, of) = (variants.summary().given, outcome.listed_counts());
    let least = if outcome.is_counted() {
        ""
    } else {
        "at least "
    };
    let why = variants.stop().word();
    Ok(Some(format!(
        "stopped early ({why}): {given} of {least}{of} admissible variants given{proven}"
    )))
}

fn write_rows(
    out: &mut dyn Write,
    outcome: &Outcome,
    variants: &mut Variants<'_>,
) -> io::Result<()> {
    let search = &outcome.search;
    let joints = joint_columns(search);
    let mut heads: Vec<&str> = FIGURES.split(',').collect();
    let names = joints
        .iter()
        .map(|&(_, j)| search.mechanism.joints[j].id.as_str());
    heads.extend(names);
    heads.extend(OPINIONS);
    let scores = if outcome.ranking.is_some() {
        score_heads()
    } else {
        Vec::new()
    };
    heads.extend(scores.iter().map(String::as_str));
    heads.extend(MORE);
    writeln!(out, "{}", heads.into_iter().map(encode_cell).join(","))?;
    let mut lines = Lines {
        text: String::new(),
        chosen: cells_of(search, &joints),
        cost: (0, format_cost(0)),
        digits: itoa::Buffer::new(),
    };
    for v in variants {
        lines.write_variant(outcome, &v);
        if lines.text.len() >= ROOM {
            out.write_all(lines.text.as_bytes())?;
            lines.text.clear();
        }
    }
    out.write_all(lines.text.as_bytes())
}

/// Bytes of lines that are written at once.
const ROOM: usize = 1 << 16;

/// Returns the variable of each column of joints, and the cells of its choices with a comma in front.
fn cells_of(search: &Search, joints: &[(usize, JointId)]) -> Vec<(usize, Vec<String>)> {
    let of = |&(variable, j): &(usize, JointId)| {
        let choices = search.space.variables[variable].choices.iter();
        let name = |c| encode_cell(&choice_name(&search.mechanism, j, c));
        (variable, choices.map(|c| format!(",{}", name(c))).collect())
    };
    joints.iter().map(of).collect()
}

/// The lines of some variants, one after another.
struct Lines {
    text: String,
    /// The cells of all choices, because lines repeat the same few words.
    chosen: Vec<(usize, Vec<String>)>,
    /// The last cost, which is often that of the next variant, too.
    cost: (i64, String),
    digits: itoa::Buffer,
}

impl Lines {
    fn write_variant(&mut self, outcome: &Outcome, v: &Variant<'_>) {
        self.text.push_str(self.digits.format(v.position()));
        if self.cost.0 != v.cost_milli() {
            self.cost = (v.cost_milli(), format_cost(v.cost_milli()));
        }
        self.text.push(',');
        self.text.push_str(&self.cost.1);
        self.push_number(v.mobility());
        self.push_number(v.redundant());
        self.push_some(v.external_redundant());
        self.push_number(v.change_count());
        let choices = &v.assignment().choices;
        for (variable, cells) in &self.chosen {
            self.text.push_str(&cells[choices[*variable]]);
        }
        let opinion = v.second().opinion();
        self.push_some(opinion.map(|o| format!("{:e}", o.conditioning)));
        self.push_some(opinion.map(|o| o.agree));
        self.push_some(v.over_stroke().and_then(OverStroke::is_lucky));
        if outcome.ranking.is_some() {
            match v.ranked() {
                Some(r) => {
                    self.push_number(r.by_cost);
                    for term in Term::ALL.into_iter().filter(|t| t.about().csv) {
                        self.push_some(Some(r.scores.term_value(term)));
                    }
                    self.push_some(Some(r.total));
                }
                None => self.text.extend(score_heads().iter().map(|_| ',')),
            }
        }
        self.push_some(v.external_harmful());
        self.text.push(',');
        self.text.push_str(&encode_cell(&contours_cell(v)));
        self.text.push('\n');
    }

    fn push_number(&mut self, n: impl itoa::Integer) {
        self.text.push(',');
        self.text.push_str(self.digits.format(n));
    }

    fn push_some(&mut self, value: Option<impl ToString>) {
        self.text.push(',');
        if let Some(x) = value {
            self.text.push_str(&x.to_string());
        }
    }
}

/// Returns σ of the contours that may have any, in the order in which they are added: "0-1-2-3: 1 (0 to 1); 0-1-6-7: 0 (0 to
/// 1)".
fn contours_cell(v: &Variant<'_>) -> String {
    let shares = v.redundant_by_contour().into_iter().flatten();
    let some = shares.filter(|(_, s)| s.range.1 > 0);
    some.map(|(name, s)| format!("{name}: {} ({} to {})", s.redundant, s.range.0, s.range.1))
        .join("; ")
}

/// Returns the joints with a choice, in file order: (variable, joint).
fn joint_columns(search: &Search) -> Vec<(usize, JointId)> {
    let variables = search.space.variables.iter().enumerate();
    let choosing = variables.filter(|(_, v)| v.choices.len() > 1);
    let mut out: Vec<_> = choosing
        .flat_map(|(v, variable)| variable.joints.iter().map(move |&j| (v, j)))
        .collect();
    out.sort_by_key(|&(_, j)| j);
    out
}
