//! Reasons why ideas help, in workshop terms and as data.

use crate::score::evaluation::terms::Peak;
use crate::score::outcome::why::{LetGo, Removed, SIDE_LOAD, Why, Whys};
use crate::search::answer::k_best::Assignment;
use crate::terms::PairWords;
use crate::view::prelude::*;

/// Maximum number of ideas explained in a text; JSON has all.
pub(super) const TOLD: usize = 3;
/// Loads below this part of the largest are not told.
const RESIDUAL: f64 = 1e-9;

/// Describes why ideas help.
pub(crate) struct Teller<'w> {
    m: &'w Mechanism,
    words: BTreeMap<String, PairWords>,
    /// What presses: "file", or the default side load in words.
    under: String,
}

impl<'w> Teller<'w> {
    /// Returns the describer of the ideas of a search.
    pub(crate) fn new(outcome: &'w Outcome, whys: &Whys<'_>) -> Teller<'w> {
        let under = if whys.is_side_load() {
            format!("{SIDE_LOAD} N on each output, along its hinge")
        } else {
            "the loads of the file".to_owned()
        };
        Teller {
            m: &outcome.search.mechanism,
            words: PairWords::builtin(),
            under,
        }
    }

    /// Returns why an idea helps as data: a row for each change, and the contours that had redundant constraints.
    pub(crate) fn why_json(&self, w: &Why) -> Value {
        let lets = |l: &LetGo| {
            json!({
                "joint": self.joint_name(l.joint),
                "part": self.part_name(l),
                "lets": describe_motions(l),
                "hardware": self.usual_part(l),
                // Directions in which they are still held.
                "holds_forces": l.holds.0,
                "holds_moments": l.holds.1,
            })
        };
        let removes =
            |r: &Removed| json!({ "contour": r.contour, "redundant": r.of, "left": r.left });
        // In N or N·m, and as part of what the joint's type bears.
        let peak = |p: Peak| json!({ "joint": self.joint_name(p.joint), "value": p.value, "utilisation": p.utilisation });
        json!({
            "lets": w.lets.iter().map(lets).collect::<Value>(),
            "removes": w.removes.iter().flatten().map(removes).collect::<Value>(),
            "unchanged": w.unchanged.iter().map(|&j| self.joint_name(j)).collect::<Value>(),
            "under": w.peaks.map(|_| &self.under),
            "peak_force": w.peaks.map(|p| peak(p[0])),
            "peak_moment": w.peaks.map(|p| peak(p[1])),
        })
    }

    fn joint_name(&self, j: JointId) -> &str {
        &self.m.joints[j].id
    }

    /// Returns a part such as "rod 5", or its name alone if it contains the word.
    fn part_name(&self, l: &LetGo) -> String {
        let part = &self.m.links[l.part].id;
        match (l.is_rod, part.to_lowercase().contains("rod")) {
            (_, true) => part.to_owned(),
            (true, _) => format!("rod {part}"),
            (false, _) => format!("link {part}"),
        }
    }

    /// Returns the usual part that is such a joint, if there is one.
    fn usual_part(&self, l: &LetGo) -> Option<&str> {
        let pair = self.words.get(l.to.as_ref()?.name())?;
        pair.hardware.first().map(String::as_str)
    }

    /// Returns the remarks on an idea as pairs of subject and text. Empty if it frees nothing.
    fn why_rows(&self, w: &Why) -> Vec<(String, String)> {
        if w.lets.is_empty() {
            return Vec::new();
        }
        let lets = w.lets.iter();
        let lets = lets.map(|l| {
            (
                describe_motions(l),
                format!("{} at {}", self.part_name(l), self.joint_name(l.joint)),
            )
        });
        let parts = w.lets.iter();
        let parts = parts.filter_map(|l| {
            Some((
                self.usual_part(l)?.to_owned(),
                self.joint_name(l.joint).to_owned(),
            ))
        });
        // What is far below the largest is rounding.
        let peaks = w.peaks.into_iter().flatten();
        let least = RESIDUAL * peaks.clone().map(|p| p.value).fold(0.0, f64::max);
        let peaks = peaks.zip(["N", "N·m"]).filter(|(p, _)| p.value > least);
        let mut peaks = peaks.map(|(p, unit)| {
            format!(
                "{} {unit} at {}",
                three_digits(p.value),
                self.joint_name(p.joint)
            )
        });
        let under = if w.peaks.is_some() { &*self.under } else { "" };
        let rows = [
            ("frees parts to".to_owned(), group_rows(lets, ": ")),
            ("hardware:".to_owned(), group_rows(parts, " at ")),
            (
                "removes:".to_owned(),
                describe_removed(w.removes.as_deref().unwrap_or_default()),
            ),
            (
                "unchanged:".to_owned(),
                w.unchanged.iter().map(|&j| self.joint_name(j)).join(", "),
            ),
            (
                format!("most heavily loaded under {under}:"),
                peaks.join(", "),
            ),
        ];
        rows.into_iter().filter(|(_, w)| !w.is_empty()).collect()
    }
}

/// Returns what is removed, contour by contour: "2 of 2 redundant constraints of loop 0-1-2-3, 1 of 3 of loop 1-2-4-5".
fn describe_removed(of: &[Removed]) -> String {
    let one = |(i, r): (usize, &Removed)| {
        let removed = r.of.saturating_sub(r.left);
        let what = if i == 0 { " redundant constraints" } else { "" };
        format!("{removed} of {}{what} of loop {}", r.of, r.contour)
    };
    of.iter().enumerate().map(one).join(", ")
}

/// Returns the motions that a part gains: "tilt both ways and float along its axis".
fn describe_motions(l: &LetGo) -> String {
    let many = |n: usize, one: &str, two: &str| match n {
        0 => None,
        1 => Some(one.to_owned()),
        _ => Some(two.to_owned()),
    };
    let all = [
        many(l.tilts, "tilt one way", "tilt both ways"),
        l.turns.then(|| "turn about its axis".to_owned()),
        l.floats.then(|| "float along its axis".to_owned()),
        many(l.shifts, "shift across one way", "shift across both ways"),
    ];
    let all = all.into_iter().flatten().collect_vec();
    match all.split_last() {
        None => "move as before".to_owned(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
    }
}

/// Returns the first ideas with the motions freed, hardware, removed constraints, unchanged joints and loads.
pub(crate) fn why_text(outcome: &Outcome, ideas: &[&Assignment]) -> String {
    let mut out = String::new();
    let first = &ideas[..ideas.len().min(TOLD)];
    for (i, rows) in rows_of_ideas(outcome, first).into_iter().enumerate() {
        for (n, (what, words)) in rows.into_iter().enumerate() {
            out += &match n {
                0 => format!("\n  idea {} {what} {words}\n", i + 1),
                _ => format!("    {what} {words}\n"),
            };
        }
    }
    out
}

/// Returns the remarks on each of some ideas as pairs of subject and text.
pub fn rows_of_ideas(outcome: &Outcome, ideas: &[&Assignment]) -> Vec<Vec<(String, String)>> {
    let whys = Whys::new(outcome);
    let (teller, mut why) = (Teller::new(outcome, &whys), whys.explain_each());
    ideas
        .iter()
        .map(|idea| teller.why_rows(&why(idea)))
        .collect()
}

/// Returns the rows that have something in common as groups: "what: these, those; other: that".
fn group_rows(rows: impl Iterator<Item = (String, String)>, between: &str) -> String {
    let groups = group_by_key(rows).into_iter();
    let mut lines = groups.map(|(what, all)| format!("{what}{between}{}", all.join(", ")));
    lines.join("; ")
}
