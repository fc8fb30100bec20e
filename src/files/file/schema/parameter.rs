//! `[parameter]`.

use super::number::Coordinate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A number that expressions know by its name.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a number, or a table such as { range = [10, 20], default = 12 } or { values = [10, 12, 15] }"
)]
pub enum ParameterEntry {
    /// One number.
    Constant(Coordinate),
    /// Varied by `ozols sweep`.
    Varied(VariedEntry),
}

/// What a parameter may be.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VariedEntry {
    /// From and to, both included.
    #[serde(default)]
    pub range: Option<[Coordinate; 2]>,
    /// These numbers alone.
    #[serde(default)]
    pub values: Option<Vec<Coordinate>>,
    /// What it is without a sweep: the middle of the range, or the first of the values, where left out.
    #[serde(default)]
    pub default: Option<Coordinate>,
}
