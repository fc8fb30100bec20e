//! A word, or a list of them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One word or several.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "expected a word in quotes or a list of them")]
pub enum Words {
    /// One.
    One(String),
    /// Several.
    Many(Vec<String>),
}
