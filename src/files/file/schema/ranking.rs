//! `[ranking]`, and the figures of joint types that it uses.

use crate::format::join_or;
use crate::model::ranking::Term;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Ranking of variants under the workload, for `ozols search`.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RankingEntry {
    /// "weighted", the only order.
    pub order: Option<String>,
    /// Terms, each with its weight in the sum by which variants are sorted.
    pub terms: Vec<TermEntry>,
    /// Limits that variants must meet.
    pub limits: Vec<LimitEntry>,
    /// Combination of clearances to the output error: "worst" (default) or "rms".
    pub clearance: Option<String>,
    /// States to rank in: "free", or those with the contacts of [workload.grip]. Default: all of them that have loads. The score
    /// of a variant is the worst of these states.
    pub states: Vec<String>,
}

/// A term with its weight.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TermEntry {
    /// Term, one of those of [`Term`].
    #[schemars(description = list_terms())]
    #[schemars(extend("enum" = Term::ALL.map(Term::name)))]
    pub term: String,
    /// Weight of the term. Default: 1.
    pub weight: Option<f64>,
}

/// Lists the terms with their meanings.
fn list_terms() -> String {
    let each = Term::ALL.map(Term::about);
    let each = each.map(|a| format!("{} ({})", a.word, a.meaning));
    format!("{}.", join_or(each.iter().map(String::as_str)))
}

/// A limit on a term.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitEntry {
    /// The term.
    #[schemars(extend("enum" = Term::ALL.map(Term::name)))]
    pub term: String,
    /// Lower limit.
    pub min: Option<f64>,
    /// Upper limit.
    pub max: Option<f64>,
}

/// Capacity of a joint type, replacing the figures of the catalogue.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointTypeEntry {
    /// Cost, as under `[search.costs]`.
    pub cost: Option<f64>,
    /// Force capacity in N.
    pub capacity_force: Option<f64>,
    /// Moment capacity in N·m.
    pub capacity_moment: Option<f64>,
    /// Clearance (play) between its parts, from the middle to the end, in m.
    pub clearance: Option<f64>,
}
