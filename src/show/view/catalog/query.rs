//! Answers to questions in SQL: as a table for people, whose heads have units, as JSON and as CSV.

use crate::format::csv;
use crate::format::plain::escape_control;
use crate::view::prelude::*;
use crate::view::terminal::table_of;
use serde::ser::{Serialize, Serializer};
use serde_json::Map;

/// The answer to a question: as JSON a list of objects.
#[derive(Debug, Clone)]
pub struct QueryAnswer {
    /// The columns.
    pub names: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<Value>>,
}

impl Serialize for QueryAnswer {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        struct QueryRow<'a>(&'a [String], &'a [Value]);
        impl Serialize for QueryRow<'_> {
            fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
                s.collect_map(self.0.iter().zip(self.1))
            }
        }
        s.collect_seq(self.rows.iter().map(|row| QueryRow(&self.names, row)))
    }
}

/// Returns a value without grouping or rounding.
pub(super) fn bare_value(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(s) => s.clone(),
        other => other.to_string(),
    }
}

/// Returns a value for people.
pub(super) fn format_value(value: &Value) -> String {
    match value {
        Value::Null => "-".to_owned(),
        Value::Number(n) if n.is_f64() => four_digits(n.as_f64().unwrap_or(f64::NAN)),
        Value::Number(n) => group_thousands(n),
        // A count beyond 63 bits.
        Value::String(s) if s.len() > 18 && s.bytes().all(|b| b.is_ascii_digit()) => {
            group_thousands(s)
        }
        // The database may be anybody's.
        Value::String(s) => escape_control(s).into_owned(),
        other => other.to_string(),
    }
}

/// Units of the columns that have one.
const UNITS: [(&str, &str); 13] = [
    ("force_per_newton", "N/N"),
    ("force_per_newton_metre", "N/Nm"),
    ("narrowest", "mm"),
    ("widest", "mm"),
    ("turn", "°"),
    ("jaw_turn", "°"),
    ("transmission", "°"),
    ("pin_force", "N/N"),
    ("width", "mm"),
    ("height", "mm"),
    ("actuator", "N mm"),
    ("price", "hinges"),
    ("cost", "hinges"),
];

/// Returns the head of a column: its name in words, and its unit.
fn column_head(name: &str) -> String {
    let words = escape_control(name).replace('_', " ");
    let unit = UNITS.iter().find(|(column, _)| *column == name);
    let Some((_, unit)) = unit else { return words };
    let (what, _) = words.split_once(" per ").unwrap_or((&words, ""));
    format!("{what} [{unit}]")
}

impl QueryAnswer {
    /// Returns rows of the same keys as an answer.
    pub fn of(rows: &[Map<String, Value>]) -> QueryAnswer {
        let names = rows
            .first()
            .map_or(Vec::new(), |row| row.keys().cloned().collect());
        let rows = rows.iter().map(|row| row.values().cloned().collect());
        QueryAnswer {
            names,
            rows: rows.collect(),
        }
    }

    /// Returns the answer as a table for people.
    pub fn text(&self, width: Option<u16>) -> String {
        let heads: Vec<String> = self.names.iter().map(|n| column_head(n)).collect();
        let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
        let rows = self
            .rows
            .iter()
            .map(|r| r.iter().map(format_value).collect());
        format!("{}\n", table_of(&heads, rows.collect(), width))
    }

    /// Returns the answer as CSV, with unrounded numbers.
    pub fn csv(&self) -> String {
        let heads: Vec<&str> = self.names.iter().map(String::as_str).collect();
        csv::write_table(
            &heads,
            self.rows
                .iter()
                .map(|r| r.iter().map(bare_value).collect::<Vec<_>>()),
        )
    }
}
