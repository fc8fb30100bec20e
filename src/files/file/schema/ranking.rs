//! `[ranking]` and `[joint_types]`.

use crate::format::disjunction;
use crate::model::ranking::Term;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How `ozols search` ranks variants under the workload.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RankingEntry {
    /// "weighted" (the default), "lexicographic" or "pareto".
    pub order: Option<String>,
    /// The terms, the most important first.
    pub terms: Vec<TermEntry>,
    /// Bounds that variants must keep.
    pub limits: Vec<LimitEntry>,
    /// How clearances add up to the output error: "worst" (the default) or "rms".
    pub clearance: Option<String>,
    /// The states that count, "free" or those with the contacts of [workload.grip]; all of them that have loads where left
    /// out. A variant's score is the worst over them.
    pub states: Vec<String>,
}

/// A term with its weight.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TermEntry {
    /// Its word, of those that [`Term`] has.
    #[schemars(description = terms())]
    #[schemars(extend("enum" = Term::ALL.map(Term::name)))]
    pub term: String,
    /// Its weight, 1 by default.
    pub weight: Option<f64>,
}

/// The words of terms with what they mean.
fn terms() -> String {
    let each = Term::ALL.map(Term::about);
    let each = each.map(|a| format!("{} ({})", a.word, a.meaning));
    format!("{}.", disjunction(each.iter().map(String::as_str)))
}

/// A bound.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitEntry {
    /// The term.
    #[schemars(extend("enum" = Term::ALL.map(Term::name)))]
    pub term: String,
    /// Not below.
    pub min: Option<f64>,
    /// Not above.
    pub max: Option<f64>,
}

/// What a joint type bears, in place of the catalogue's figures.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointTypeEntry {
    /// Its cost, as under `[search.costs]`.
    pub cost: Option<f64>,
    /// The force it bears in N.
    pub capacity_force: Option<f64>,
    /// The moment it bears in N·m.
    pub capacity_moment: Option<f64>,
    /// Play between its parts, from the middle to the end, in m.
    pub clearance: Option<f64>,
}
