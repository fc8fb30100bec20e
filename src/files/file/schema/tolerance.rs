//! `[tolerance]`.

use super::number::Coordinate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How well the numbers of the file are known, in place of half a unit of their last digit; expressions are exact all the same.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToleranceEntry {
    /// Points, pitches and leads are within so much of what is meant, in the file's unit of length; 0 where they are exact.
    #[serde(default)]
    pub length: Option<Coordinate>,
    /// Axes and references are, in radians; 0 where they are exact.
    #[serde(default)]
    pub direction: Option<Coordinate>,
}
