//! A variant as data, by the same contract as the search it is of, and the cheapest symmetric redesigns for people and as data.

use crate::format::cost;
use crate::model::mechanism::Mechanism;
use crate::score::outcome::Outcome;
use crate::score::outcome::symmetric::SymmetricBest;
use crate::score::outcome::variant::{Change, Variant, changes, in_words};
use crate::search::answer::freedom_patterns;
use crate::search::answer::k_best::Assignment;
use crate::search::check::other_poses::OverStroke;
use crate::search::check::singular_values::Opinion;
use crate::view::search::ranking::RankedData;
use crate::view::search::why::WhyData;
use serde::Serialize;
use std::fmt::Write;

/// One variant.
#[derive(Debug, Serialize)]
pub struct VariantData<'a> {
    position: usize,
    cost: Cost,
    mobility: i64,
    redundant: u32,
    external_redundant: Option<i32>,
    external_harmful: Option<u32>,
    per_contour: Vec<ContourData>,
    changes: Vec<ChangeData<'a>>,
    idea: Option<IdeaData>,
    scores: ScoresData<'a>,
    conditioning: Option<f64>,
    agree: Option<bool>,
    svd: Option<Opinion>,
    lucky: Option<bool>,
    stroke: Option<OtherPoses>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum Cost {
    Whole(i64),
    Part(f64),
}

impl Cost {
    /// Returns a cost given in thousandths.
    #[allow(clippy::cast_precision_loss, reason = "costs are small")]
    pub(crate) fn of(milli: i64) -> Cost {
        match milli % 1000 {
            0 => Cost::Whole(milli / 1000),
            _ => Cost::Part(milli as f64 / 1000.0),
        }
    }
}

/// σ of a contour when they are added in the order given, with the range over all orders of these contours.
#[derive(Debug, Serialize)]
struct ContourData {
    contour: String,
    redundant: usize,
    least: usize,
    greatest: usize,
}

#[derive(Debug, Serialize)]
struct ChangeData<'a> {
    joint: &'a str,
    from: String,
    to: String,
}

impl<'a> ChangeData<'a> {
    /// Returns changes of a mechanism.
    pub(in crate::view) fn of(m: &'a Mechanism, changes: Vec<Change>) -> Vec<ChangeData<'a>> {
        let one = |c: Change| ChangeData {
            joint: &m.joints[c.joint].id,
            from: c.from,
            to: c.to,
        };
        changes.into_iter().map(one).collect()
    }
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum ScoresData<'a> {
    Ranked(Box<RankedData<'a>>),
    Unranked {},
}

/// What the first variant of an idea stands for.
#[derive(Debug, Serialize)]
struct IdeaData {
    /// A number of any size, as text.
    variants: String,
    /// Whether that is all of them; a lower bound otherwise.
    exact: bool,
    /// What all of them add, in words.
    adds: String,
    /// Why it helps, where that was asked.
    why: Option<WhyData>,
}

#[derive(Debug, Serialize)]
struct OtherPoses {
    poses: usize,
    other: Option<OtherPose>,
}

#[derive(Debug, Serialize)]
struct OtherPose {
    mobility: i64,
    redundant: i64,
    output_mobility: Option<i64>,
    present_output_mobility: Option<i64>,
}

impl<'a> VariantData<'a> {
    /// Of a variant of an outcome.
    #[must_use]
    pub fn new(outcome: &'a Outcome, v: &Variant<'a>) -> Self {
        let mechanism = &outcome.search.mechanism;
        let opinion = v.second().opinion();
        VariantData {
            position: v.position(),
            cost: Cost::of(v.cost_milli()),
            mobility: v.mobility(),
            redundant: v.redundant(),
            external_redundant: v.external_redundant(),
            external_harmful: v.external_harmful(),
            per_contour: v
                .redundant_by_contour()
                .into_iter()
                .flatten()
                .map(|(contour, share)| ContourData {
                    contour,
                    redundant: share.redundant,
                    least: share.range.0,
                    greatest: share.range.1,
                })
                .collect(),
            changes: ChangeData::of(mechanism, v.changes()),
            idea: v.idea().map(|i| IdeaData {
                variants: i.variants.to_string(),
                exact: outcome.is_exact(),
                adds: freedom_patterns::in_words(mechanism, &i.added),
                why: None,
            }),
            scores: v.ranked().map_or(ScoresData::Unranked {}, |r| {
                ScoresData::Ranked(Box::new(RankedData::new(mechanism, r, v.reason())))
            }),
            conditioning: opinion.map(|o| o.conditioning),
            agree: opinion.map(|o| o.agree),
            svd: opinion.copied(),
            lucky: v.over_stroke().and_then(OverStroke::lucky),
            stroke: v.over_stroke().map(OtherPoses::new),
        }
    }
}

impl VariantData<'_> {
    /// The same with why it helps, where it is an idea.
    #[must_use]
    pub(in crate::view) fn because(mut self, why: Option<WhyData>) -> Self {
        if let Some(idea) = &mut self.idea {
            idea.why = why;
        }
        self
    }
}

impl OtherPoses {
    fn new(s: &OverStroke) -> OtherPoses {
        OtherPoses {
            poses: s.poses,
            other: s.other.map(|(f, present)| OtherPose {
                mobility: f.mobility,
                redundant: f.redundant,
                output_mobility: f.output,
                present_output_mobility: present,
            }),
        }
    }
}

/// Returns a line for each number of redundant constraints left, under a heading.
pub(in crate::view) fn symmetric_text(found: &SymmetricBest) -> String {
    let SymmetricBest { search, best, odd } = found;
    let mut out = String::from("\n  the cheapest symmetric redesign for each σ left:\n");
    // Writing to a string cannot fail.
    for (left, v) in best {
        let price = cost(search.steps.milli(v.key.cost()));
        let (w, words) = (
            search.mobility(v.key),
            in_words(search, &changes(search, v)),
        );
        let _ = writeln!(out, "    σ = {left}: cost {price}, W = {w}, {words}");
    }
    if best.is_empty() {
        out += "    none with the options offered and at most 2 redundant constraints\n";
    }
    if let Some(odd) = odd {
        let _ = writeln!(
            out,
            "    none has σ = 0 without idle motion: that takes {} more freedoms, and joints that are images of each other gain them {} at a time",
            odd.needed, odd.at_a_time
        );
    }
    out
}

/// A symmetric redesign as data.
#[derive(Debug, Serialize)]
pub(in crate::view) struct SymmetricData<'a> {
    redundant: u32,
    cost: Cost,
    mobility: i64,
    changes: Vec<ChangeData<'a>>,
}

/// Returns the cheapest symmetric redesigns as data.
pub(in crate::view) fn symmetric_data(found: &SymmetricBest) -> Vec<SymmetricData<'_>> {
    let search = &found.search;
    let one = |(left, v): &(u32, Assignment)| SymmetricData {
        redundant: *left,
        cost: Cost::of(search.steps.milli(v.key.cost())),
        mobility: search.mobility(v.key),
        changes: ChangeData::of(&search.mechanism, changes(search, v)),
    };
    found.best.iter().map(one).collect()
}
