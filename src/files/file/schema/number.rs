//! Numbers and words as files write them, and `[tolerance]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A number, or an exact expression in quotes: "sqrt(3)/2", "cos(36deg)", "tan(pi/8)", "1/3".
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a number, or an expression in quotes such as \"sqrt(3)/2\""
)]
pub enum Coordinate {
    /// A whole number.
    Integer(i64),
    /// A decimal, taken exactly as written.
    Decimal(f64),
    /// An expression.
    Expression(String),
}

impl Default for Coordinate {
    fn default() -> Coordinate {
        Coordinate::Integer(0)
    }
}

/// A number, or a number with a unit in quotes: "360deg", "60rpm".
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a number, or a number with its unit in quotes such as \"360deg\""
)]
pub enum Quantity {
    /// A number in SI units, lengths in the file's unit.
    Number(f64),
    /// A number with a unit.
    Text(String),
}

/// One quantity or several.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number or a list of numbers")]
pub enum Quantities {
    /// One quantity.
    One(Quantity),
    /// Several quantities.
    Many(Vec<Quantity>),
}

/// Accuracy of the numbers of the file, instead of half a unit of their last digit. Expressions are always exact.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToleranceEntry {
    /// Uncertainty of points, pitches and leads, in the file's unit of length; 0 if they are exact.
    pub length: Option<Coordinate>,
    /// Uncertainty of axes and references, in radians; 0 if they are exact.
    pub direction: Option<Coordinate>,
}

/// One word or several.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "expected a word in quotes or a list of them")]
pub enum Words {
    /// One word.
    One(String),
    /// Several words.
    Many(Vec<String>),
}
