//! Redundant constraints of robot descriptions, as text and JSON.

use crate::redundancy::duplicate_constraints::HeldTwice;
use crate::redundancy::release::Duplicate;
use crate::robots::{Imported, Origin};
use crate::view::prelude::*;
use crate::view::with_assumptions;
pub use finding::{Finding, Misfit, NONE, PassedOver, TypeChange, describe_release};
use finding::{LintWords, describe_count, describe_then};

mod finding;

/// Notes told of how a file was read.
const NOTES: usize = 6;

/// How sure what is found in an open assembly is.
const NUMERIC: &str = "numeric";
const OF_THIS_POSE: &str =
    "of the pose of the file alone, where joints are open or taken as they are there";

/// Findings in one file.
#[derive(Debug, Serialize)]
pub struct Lint {
    /// Name of the file.
    pub file: String,
    /// W.
    pub mobility: usize,
    /// σ, or its lower bound if it is not decided.
    pub redundant: usize,
    /// The most that σ can be.
    pub redundant_at_most: usize,
    /// How many of them are redundant over the motion, as far as is known; the others are so at this pose only.
    pub redundant_over_motion: usize,
    /// How sure σ is, in a word, and in a line.
    pub certainty_kind: &'static str,
    /// The line.
    pub certainty: String,
    /// Range of poses in which it holds, in a word: proven, followed, seen, rigid, pose or unknown. `None` if σ = 0.
    pub over_motion_kind: Option<&'static str>,
    /// In words.
    pub over_motion: Option<String>,
    /// Number of rows of couplings that the figures omit: W may be too high by it, and σ too low.
    pub left_out: usize,
    /// Elements that were approximated, or omitted although they may constrain or move something.
    pub approximated: Vec<String>,
    /// Guesses and omissions among these; the certainty counts them.
    pub assumptions: Vec<String>,
    /// How many they are, in words.
    #[serde(skip)]
    read_with: Option<String>,
    /// Differences from the drawing: joints moved to close loops, floating bases.
    pub moved: Vec<String>,
    /// Joints that stand outside their limits in the pose that the figures are of.
    pub outside_limits: Vec<String>,
    /// Each redundant constraint.
    pub findings: Vec<Finding>,
    /// The cheapest releases that remove them all and add no mobility. Empty if there are not enough.
    pub cheapest: Vec<String>,
    /// Freedoms as a CAD program counts them, six per part less all constraints, if the file is one of its assemblies.
    pub counted: Option<i64>,
    /// Which joints to give another type, where they are those of a CAD program.
    pub changes: Vec<TypeChange>,
    /// W then: more than now where a part may turn or slide without anything else moving.
    pub mobility_then: Option<usize>,
    /// True if the file is a robot description, which can be fixed.
    #[serde(skip)]
    pub from_description: bool,
}

impl Lint {
    /// Describes the findings in a mechanism, in the words of its description if it came from one.
    ///
    /// # Examples
    /// ```
    /// use ozols::{redundancy::duplicate_constraints::held_twice, view::lint::Lint};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let found = held_twice(&four_bar, &|_| false, &|_| true, None)?;
    /// let lint = Lint::new("four-bar.toml", &four_bar, None, &found);
    /// assert!(lint.is_decided() && !lint.is_clean());
    /// assert_eq!((lint.redundant, lint.cheapest.len()), (3, 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(file: &str, m: &Mechanism, read: Option<&Imported>, found: &HeldTwice) -> Lint {
        let origin = read.map(|i| &i.origin);
        let report = read.map(|i| &i.report);
        let (least, most) = found.range();
        let words = LintWords { m, found };
        let finding =
            |(i, d): (usize, &Duplicate)| words.make_finding(d, i < found.lasting, origin);
        let whole = found.cheapest.len() == found.lasting;
        let certainty = &found.analysis.certainty;
        let sure = if origin.is_some_and(Origin::is_of_this_pose) && most == least {
            (NUMERIC, OF_THIS_POSE.to_owned())
        } else {
            (certainty.as_word(), certainty.describe())
        };
        let sure = (certainty_kind(m, sure.0), as_read(m, sure.1));
        Lint {
            file: file.to_owned(),
            mobility: found.analysis.mobility,
            redundant: least,
            redundant_at_most: most,
            redundant_over_motion: found.lasting,
            certainty_kind: sure.0,
            certainty: sure.1,
            over_motion_kind: found.over.map(|o| match o.as_word() {
                "proven" => certainty_kind(m, "proven"),
                word => word,
            }),
            over_motion: found.over.map(|o| as_read(m, o.describe())),
            left_out: report.map_or(0, |r| r.left_out),
            approximated: report.map_or(Vec::new(), |r| r.approximated.clone()),
            assumptions: m.assumed.clone(),
            read_with: with_assumptions(m),
            moved: report.map_or(Vec::new(), |r| r.moved.clone()),
            outside_limits: origin.map_or(Vec::new(), Origin::outside_limits),
            findings: found.list.iter().enumerate().map(finding).collect(),
            cheapest: if whole {
                found
                    .cheapest
                    .iter()
                    .map(|&i| words.describe_remedy(i, origin))
                    .collect()
            } else {
                Vec::new()
            },
            counted: report.and_then(|r| r.cad_freedoms),
            changes: Vec::new(),
            mobility_then: None,
            from_description: read.is_some(),
        }
    }

    /// Returns the result with the new types of joints, and W with them. They come before single freedoms.
    pub fn with_changes(mut self, found: Option<(Vec<TypeChange>, usize)>) -> Lint {
        if let Some((changes, mobility)) = found {
            self.cheapest = changes.iter().map(TypeChange::describe_change).collect();
            (self.changes, self.mobility_then) = (changes, Some(mobility));
        }
        self
    }

    /// Returns true if nothing is redundant over the motion.
    pub fn is_clean(&self) -> bool {
        self.redundant_over_motion == 0
    }

    /// Returns true if nothing is redundant and no row that could be redundant was omitted.
    pub fn is_in_order(&self) -> bool {
        self.is_clean() && self.left_out == 0
    }

    /// Returns the number of redundant constraints that hold in this pose only.
    fn passing_count(&self) -> usize {
        self.redundant_at_most - self.redundant_over_motion
    }

    /// Returns true if σ is one number.
    pub fn is_decided(&self) -> bool {
        self.redundant == self.redundant_at_most
    }

    /// Returns the findings, a paragraph each.
    pub fn text(&self) -> String {
        let Lint { file, mobility, .. } = self;
        if self.redundant_at_most == 0 {
            return format!(
                "{file}: {NONE} (σ = 0, W = {mobility}){}\n{}{}",
                self.left_out(),
                describe_count(self.counted.filter(|_| self.left_out == 0), self.mobility),
                self.note_lines()
            );
        }
        let (sigma, passing) = (self.sigma_words(), self.passing_count());
        let mut out = if self.is_clean() {
            format!(
                "{file}: {NONE} over the motion; {sigma} at this pose, W = {mobility} there{}\n",
                self.left_out()
            )
        } else {
            let over = if self.redundant > 0 {
                "overconstrained: "
            } else {
                ""
            };
            format!("{file}: {over}{sigma}, W = {mobility}{}\n", self.left_out())
        };
        if passing > 0 && !self.is_clean() {
            out += &format!("  {passing} of them at this pose only\n");
        }
        out += &describe_count(self.counted.filter(|_| self.left_out == 0), self.mobility);
        if let Some(over) = &self.over_motion {
            let what = if self.is_decided() {
                "redundant"
            } else {
                "what is redundant is so"
            };
            out += &format!("  {what} {over}\n");
        }
        out += &self.note_lines();
        for f in &self.findings {
            let place = match (&f.file, f.line, f.column) {
                (Some(file), Some(line), Some(column)) => format!("{file}:{line}:{column}: "),
                _ => String::new(),
            };
            let note = if f.lasts { "" } else { "note: " };
            out += &format!("\n{place}{note}{}\n", f.message);
            if !f.remedies.is_empty() {
                out += &format!("  remedies: {}\n", f.remedies.join("; "));
            }
        }
        if self.findings.is_empty() {
            out += "\n  the digits do not decide which constraints these are\n";
        }
        if !self.cheapest.is_empty() {
            out += &format!(
                "\n  cheapest that removes all{}: {}{}\n",
                if passing > 0 { " that last" } else { "" },
                self.cheapest.join("; "),
                describe_then(self.mobility, self.mobility_then)
            );
        }
        out
    }

    /// Returns what was not taken as it is drawn, in lines.
    fn note_lines(&self) -> String {
        let notes = || {
            let moved = self.moved.iter().chain(&self.outside_limits);
            moved.chain(&self.approximated)
        };
        let mut out: String = notes()
            .take(NOTES)
            .map(|n| format!("  note: {n}\n"))
            .collect();
        if let more @ 1.. = notes().count().saturating_sub(NOTES) {
            out += &format!(
                "  note: {more} more of the kind, which `ozols export {}` tells\n",
                typed_option("to", "toml")
            );
        }
        out
    }

    /// Describes why the figures are not those of the description.
    fn left_out(&self) -> String {
        let rows = match self.left_out {
            0 => String::new(),
            n => format!(
                "; {} between joints omitted, which may be redundant and lower W",
                count_noun(n, "row")
            ),
        };
        let read = self.read_with.as_ref().map(|r| format!("; {r}"));
        rows + &read.unwrap_or_default()
    }

    /// Describes σ: "2 redundant constraints (σ = 2)", "0 to 2 redundant constraints (...)".
    pub fn sigma_words(&self) -> String {
        let (least, most) = (self.redundant, self.redundant_at_most);
        if self.is_decided() {
            format!(
                "{} (σ = {most}, {})",
                count_noun(most, "redundant constraint"),
                self.certainty_kind
            )
        } else {
            format!(
                "{least} to {most} redundant constraints (undecided: coordinates are rounded too coarsely)"
            )
        }
    }
}

/// Returns the findings in some files as JSON, and the files that were skipped.
///
/// # Examples
/// ```
/// assert_eq!(ozols::view::lint::lint_json(&[], &[])["files"], serde_json::json!([]));
/// ```
pub fn lint_json(all: &[&Lint], passed_over: &[PassedOver]) -> Value {
    let mut out = json!({ "files": all });
    if !passed_over.is_empty() {
        out["passed_over"] = json!(passed_over);
    }
    out
}
