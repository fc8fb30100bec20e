//! Single changes in words and as data, and what to do after an analysis.

use crate::format::cost;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::Certainty;
use crate::redundancy::analysis::StateAnalysis;
use crate::search::answer::single_changes::{self, Suggestion, single_changes};
use crate::view::terminal::layout::table;
use itertools::Itertools;
use serde::{Serialize, Serializer};

/// Rows of a table at most.
const ROWS: usize = 5;
/// Joints named in a row at most.
const JOINTS: usize = 12;
/// Entries of a JSON list at most.
const ENTRIES: usize = 50;

/// What can be suggested for a state.
#[derive(Debug, Clone)]
pub enum Advice {
    /// There is nothing to remove, or nothing the state adds.
    Nothing,
    /// These changes.
    Changes(single_changes::Suggestions),
    /// None can be told, and why.
    Silent(&'static str),
}

/// How many redundant constraints of a state suggestions are about: its own, or those it adds.
#[must_use]
pub fn concerned(s: &StateAnalysis) -> usize {
    match &s.external {
        None => s.redundant,
        Some(e) => usize::try_from(e.by_rank).unwrap_or(0),
    }
}

/// What single changes would do in each state, on the geometry that the analysis is about.
///
/// # Errors
/// Where a geometry has no exact image.
pub fn advise(
    mechanism: &Mechanism,
    states: &[StateId],
    found: &[StateAnalysis],
) -> Result<Vec<Advice>, ExactError> {
    let one = |(&state, s): (&StateId, &StateAnalysis)| {
        if concerned(s) == 0 {
            return Ok(Advice::Nothing);
        }
        if matches!(s.certainty, Certainty::Undecided { .. }) {
            return Ok(Advice::Silent(
                "which constraints are redundant is not decided",
            ));
        }
        let found = single_changes(s.meant.as_deref().unwrap_or(mechanism), state)?;
        Ok(if found.redundant == s.redundant {
            Advice::Changes(found)
        } else {
            Advice::Silent(
                "the redundant constraints are there within the tolerance only, not as the coordinates are written",
            )
        })
    };
    states.iter().zip(found).map(one).collect()
}

/// What single changes would do in a state.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Suggestions<'a> {
    /// There is nothing to remove.
    Nothing,
    /// None can be told.
    Silent {
        /// Why.
        reason: &'static str,
        /// No changes.
        changes: [(); 0],
    },
    /// What was found.
    Found(SuggestionsFound<'a>),
}

/// The single changes found.
#[derive(Debug, Serialize)]
pub struct SuggestionsFound<'a> {
    /// How many redundant constraints they are about.
    pub of: usize,
    /// Whether these are those that the state adds.
    pub external: bool,
    /// "usual" where the file offered nothing here, else "file".
    pub options: &'static str,
    /// Number of changes tried.
    pub tried: usize,
    /// Number of changes that remove something.
    pub found: usize,
    /// Those that remove most first, then the cheaper, then in file order; the first of them as data.
    #[serde(serialize_with = "first_entries")]
    pub changes: Vec<SuggestedChange<'a>>,
    /// The state, 0 for the free one.
    #[serde(skip)]
    pub(in crate::view) state: StateId,
}

/// One change.
#[derive(Debug, Serialize)]
pub struct SuggestedChange<'a> {
    /// The joint.
    pub joint: &'a str,
    /// What it is.
    pub from: &'a str,
    /// What it becomes, where it does not stay.
    pub to: Option<&'a str>,
    /// The unloading joint put in series with it, where one is.
    pub unloading: Option<&'a str>,
    /// Redundant constraints that go.
    pub removes: usize,
    /// Those that are left.
    pub remaining: usize,
    /// Its cost.
    pub cost: f64,
    /// All that in words.
    pub text: String,
    #[serde(skip)]
    cost_milli: i64,
}

fn first_entries<S: Serializer>(changes: &[SuggestedChange<'_>], to: S) -> Result<S::Ok, S::Error> {
    changes[..changes.len().min(ENTRIES)].serialize(to)
}

impl<'a> Suggestions<'a> {
    /// The advice on a state of a mechanism.
    #[must_use]
    pub fn new(m: &'a Mechanism, s: &StateAnalysis, advice: &'a Advice) -> Suggestions<'a> {
        let found = match advice {
            Advice::Nothing => return Suggestions::Nothing,
            Advice::Silent(reason) => {
                return Suggestions::Silent {
                    reason,
                    changes: [],
                };
            }
            Advice::Changes(found) => found,
        };
        let (of, external) = (concerned(s), s.external.is_some());
        Suggestions::Found(SuggestionsFound {
            of,
            external,
            options: if found.usual { "usual" } else { "file" },
            tried: found.tried,
            found: found.list.len(),
            changes: found
                .list
                .iter()
                .map(|x| SuggestedChange::new(m, x, of, external))
                .collect(),
            state: found.state,
        })
    }

    /// The best as a table, or that there are none.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        match self {
            Suggestions::Nothing => String::new(),
            Suggestions::Silent { reason, .. } => {
                format!("\n  No single changes are suggested: {reason}\n")
            }
            Suggestions::Found(found) => found.text(width),
        }
    }
}

impl<'a> SuggestedChange<'a> {
    fn new(m: &'a Mechanism, s: &'a Suggestion, of: usize, external: bool) -> SuggestedChange<'a> {
        let joint = &m.joints[s.joint];
        let present = joint.options.first();
        let mut change = SuggestedChange {
            joint: &joint.id,
            from: present.map_or(joint.joint_type.name(), |o| &o.name),
            to: s.to.as_ref().map(|o| o.name.as_str()),
            unloading: s.unloading.as_ref().map(|o| o.name.as_str()),
            removes: s.removes,
            remaining: of.saturating_sub(s.removes),
            cost: cost(s.cost_milli).parse().unwrap_or(0.0),
            text: String::new(),
            cost_milli: s.cost_milli,
        };
        let (removes, kind) = (s.removes, kind(external));
        let what = change.words();
        change.text = format!("{}: {what} removes {removes} of {of}{kind}", joint.id);
        change
    }

    /// "revolute -> spherical", "unloading joint in series: spherical (a ball pivot)".
    fn words(&self) -> String {
        let replaced = self.to.map(|to| format!("{} -> {to}", self.from));
        let inserted = self.unloading.map(|u| {
            let pivot = if u == "spherical" {
                " (a ball pivot)"
            } else {
                ""
            };
            format!("unloading joint in series: {u}{pivot}")
        });
        replaced.into_iter().chain(inserted).join(" + ")
    }
}

fn kind(external: bool) -> &'static str {
    if external { " external" } else { "" }
}

impl SuggestionsFound<'_> {
    fn text(&self, width: Option<u16>) -> String {
        let source = match (self.options, self.state) {
            ("file", _) => "the file's options",
            (_, StateId::FREE) => "the usual options, as the file has none",
            _ => "ball pivots in series with the contacts, as the file has no unloading joints",
        };
        let tried = self.tried;
        if self.changes.is_empty() {
            return format!(
                "\n  No single change of {tried} tried ({source}) removes a redundant constraint and leaves all motions as they are\n"
            );
        }
        // The list is sorted, and so are the groups by their firsts.
        /// What a change is, what it removes and what it costs.
        type Kind = (String, usize, i64);
        let mut groups: Vec<(Kind, Vec<&str>)> = Vec::new();
        for x in &self.changes {
            let key = (x.words(), x.removes, x.cost_milli);
            match groups.iter_mut().find(|(k, _)| *k == key) {
                Some((_, joints)) => joints.push(x.joint),
                None => groups.push((key, vec![x.joint])),
            }
        }
        let rest = match groups.len().saturating_sub(ROWS) {
            0 => String::new(),
            n => format!("\n  and {n} more; --format json lists them"),
        };
        let rows = groups.into_iter().take(ROWS);
        let rows = rows.map(|((what, removes, milli), joints)| {
            let more = match joints.len().saturating_sub(JOINTS) {
                0 => String::new(),
                n => format!(" and {n} more"),
            };
            vec![
                format!("{}{more}", joints.iter().take(JOINTS).join(", ")),
                what,
                format!("{removes} of {}{}", self.of, kind(self.external)),
                cost(milli),
            ]
        });
        let at = if self.found == 1 { "at" } else { "at (one of)" };
        let body = table(&[at, "change", "removes", "cost"], rows.collect(), width);
        let loose = if self.state != StateId::FREE {
            "\n  (the pad of an unloading joint hangs loose while nothing is held)"
        } else {
            ""
        };
        format!(
            "\n  Single changes that remove redundant constraints and leave all motions as they are\n  (of {tried} tried: {source}):\n\n{body}{rest}{loose}\n"
        )
    }
}
