//! Why ideas help, in words of the shop, and as data.

use crate::format::brief;
use crate::model::mechanism::{JointId, Mechanism};
use crate::score::evaluation::terms::Peak;
use crate::score::outcome::Outcome;
use crate::score::outcome::why::{LetGo, Removed, SIDE_LOAD, Why, Whys};
use crate::search::answer::k_best::Assignment;
use crate::terms::PairWords;
use itertools::Itertools;
use serde::Serialize;
use std::collections::BTreeMap;

/// Ideas that a text says why of: the first. Data have all.
const TOLD: usize = 3;
/// Loads below this part of the largest are not told.
const RESIDUAL: f64 = 1e-9;

/// Why an idea helps, as data.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct WhyData {
    /// One row for each change.
    lets: Vec<LetData>,
    /// Redundant constraints of each contour that had some, as built and left.
    removes: Vec<RemovedData>,
    /// Joints that stay as they are.
    unchanged: Vec<String>,
    /// What presses: "file", or the default side load in words.
    under: Option<String>,
    peak_force: Option<PeakData>,
    peak_moment: Option<PeakData>,
}

#[derive(Debug, Clone, Serialize)]
struct LetData {
    joint: String,
    part: String,
    /// "tilt both ways and float along its axis"
    lets: String,
    /// The usual part that is such a joint.
    hardware: Option<String>,
    /// Directions in which forces, and moments, are still held.
    holds_forces: usize,
    holds_moments: usize,
}

#[derive(Debug, Clone, Serialize)]
struct RemovedData {
    contour: String,
    redundant: usize,
    left: usize,
}

/// In N or N·m, at a joint, and as part of what its type bears.
#[derive(Debug, Clone, Serialize)]
struct PeakData {
    joint: String,
    value: f64,
    utilisation: f64,
}

/// What says why ideas help, one after another.
pub(in crate::view) fn teller<'w>(
    whys: &'w Whys<'_>,
    m: &'w Mechanism,
) -> impl FnMut(&Assignment) -> WhyData + 'w {
    let words = PairWords::builtin();
    let under = if whys.is_side_load() {
        format!("{SIDE_LOAD} N on each output, along its hinge")
    } else {
        "the loads of the file".to_owned()
    };
    let mut why = whys.teller();
    move |idea| {
        let w: Why = why(idea);
        WhyData {
            lets: w.lets.iter().map(|l| LetData::new(m, l, &words)).collect(),
            removes: w
                .removes
                .into_iter()
                .flatten()
                .map(RemovedData::from)
                .collect(),
            unchanged: ids(m, &w.unchanged),
            under: w.peaks.map(|_| under.clone()),
            peak_force: w.peaks.map(|[force, _]| PeakData::new(m, &force)),
            peak_moment: w.peaks.map(|[_, moment]| PeakData::new(m, &moment)),
        }
    }
}

fn ids<'a>(m: &Mechanism, joints: impl IntoIterator<Item = &'a JointId>) -> Vec<String> {
    let id = |j: &JointId| m.joints[*j].id.clone();
    joints.into_iter().map(id).collect()
}

impl LetData {
    fn new(m: &Mechanism, l: &LetGo, words: &BTreeMap<String, PairWords>) -> LetData {
        let part = &m.links[l.part].id;
        let pair = l.to.as_ref().and_then(|t| words.get(t.name()));
        LetData {
            joint: m.joints[l.joint].id.clone(),
            part: named(part, l.is_rod),
            lets: motions(l),
            hardware: pair.and_then(|p| p.hardware.first().cloned()),
            holds_forces: l.holds.0,
            holds_moments: l.holds.1,
        }
    }
}

impl From<Removed> for RemovedData {
    fn from(r: Removed) -> Self {
        RemovedData {
            contour: r.contour,
            redundant: r.of,
            left: r.left,
        }
    }
}

/// Returns what is removed, contour by contour: "2 of 2 redundant constraints of loop 0-1-2-3, 1 of 3 of loop 1-2-4-5".
fn removed(of: &[RemovedData]) -> String {
    let one = |(i, r): (usize, &RemovedData)| {
        let removed = r.redundant.saturating_sub(r.left);
        let what = if i == 0 { " redundant constraints" } else { "" };
        format!("{removed} of {}{what} of loop {}", r.redundant, r.contour)
    };
    of.iter().enumerate().map(one).join(", ")
}

impl PeakData {
    fn new(m: &Mechanism, p: &Peak) -> PeakData {
        PeakData {
            joint: m.joints[p.joint].id.clone(),
            value: p.value,
            utilisation: p.utilisation,
        }
    }
}

/// "rod 5"; the name alone where it says so itself.
fn named(part: &str, is_rod: bool) -> String {
    match (is_rod, part.to_lowercase().contains("rod")) {
        (_, true) => part.to_owned(),
        (true, _) => format!("rod {part}"),
        (false, _) => format!("link {part}"),
    }
}

/// What a part may do: "tilt both ways and float along its axis".
fn motions(l: &LetGo) -> String {
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

/// The first ideas with what each lets go, its hardware, what it removes, what stays, and what joints bear.
pub(in crate::view) fn text(outcome: &Outcome, ideas: &[&Assignment]) -> String {
    let whys = Whys::new(outcome);
    let why = teller(&whys, &outcome.search.mechanism);
    let first = ideas.iter().take(TOLD).copied();
    let all = first.map(why).enumerate();
    all.filter(|(_, w)| !w.lets.is_empty())
        .map(|(i, w)| w.lines(i + 1))
        .collect()
}

/// What is said of each of some ideas, line by line: of what, and that.
#[must_use]
pub(crate) fn told(outcome: &Outcome, ideas: &[&Assignment]) -> Vec<Vec<(String, String)>> {
    let whys = Whys::new(outcome);
    let why = teller(&whys, &outcome.search.mechanism);
    let all = ideas.iter().copied().map(why);
    all.map(|w| {
        if w.lets.is_empty() {
            Vec::new()
        } else {
            w.rows()
        }
    })
    .collect()
}

/// Those of some rows that have something in common, together: "what: these, those; other: that".
fn grouped<'a>(rows: impl Iterator<Item = (&'a str, String)>, between: &str) -> String {
    let mut groups: Vec<(&str, Vec<String>)> = Vec::new();
    for (what, one) in rows {
        match groups.iter_mut().find(|(w, _)| *w == what) {
            Some((_, all)) => all.push(one),
            None => groups.push((what, vec![one])),
        }
    }
    let mut lines = groups
        .iter()
        .map(|(what, all)| format!("{what}{between}{}", all.join(", ")));
    lines.join("; ")
}

impl WhyData {
    fn lines(&self, idea: usize) -> String {
        let mut out = String::new();
        for (what, words) in self.rows() {
            if out.is_empty() {
                out += &format!("\n  idea {idea} {what} {words}\n")
            } else {
                out += &format!("    {what} {words}\n")
            }
        }
        out
    }

    /// What is said of it, line by line: of what, and that.
    fn rows(&self) -> Vec<(String, String)> {
        let lets = self.lets.iter();
        let lets = lets.map(|l| (l.lets.as_str(), format!("{} at {}", l.part, l.joint)));
        let parts = self.lets.iter();
        let parts = parts.filter_map(|l| Some((l.hardware.as_deref()?, l.joint.clone())));
        // What is far below the largest is rounding.
        let both = [&self.peak_force, &self.peak_moment].into_iter().flatten();
        let least = RESIDUAL * both.map(|p| p.value).fold(0.0, f64::max);
        let peak = |p: &Option<PeakData>, unit: &str| {
            let p = p.as_ref().filter(|p| p.value > least)?;
            Some(format!("{} {unit} at {}", brief(p.value), p.joint))
        };
        let peaks = [peak(&self.peak_force, "N"), peak(&self.peak_moment, "N·m")];
        let under = self.under.as_deref().unwrap_or_default();
        let rows = [
            ("lets parts".to_owned(), grouped(lets, ": ")),
            ("hardware:".to_owned(), grouped(parts, " at ")),
            ("removes:".to_owned(), removed(&self.removes)),
            ("unchanged:".to_owned(), self.unchanged.join(", ")),
            (
                format!("hardest used under {under}:"),
                peaks.into_iter().flatten().join(", "),
            ),
        ];
        rows.into_iter().filter(|(_, w)| !w.is_empty()).collect()
    }
}
