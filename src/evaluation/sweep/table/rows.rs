//! The rows of a table, and their digest.

use super::head::Head;
use crate::shard::Digest;
use crate::sweep::row::SampleRow;
use serde::Serialize;

/// A table that was read or made.
#[derive(Debug, Clone)]
pub struct Table {
    /// What it is of.
    pub head: Head,
    /// The rows, by number of their samples.
    pub rows: Vec<SampleRow>,
    /// Whether it has all of its rows.
    pub finished: bool,
    /// How many rows were added now.
    pub added: usize,
    /// The digest of its rows, as they stand in the file.
    pub digest: Digest,
}

impl Table {
    /// Takes in rows; their lines.
    pub(super) fn add(&mut self, rows: Vec<SampleRow>) -> String {
        let mut text = String::new();
        for row in &rows {
            let line = line(row);
            self.digest.add(&line);
            text += &line;
        }
        self.added += rows.len();
        self.rows.extend(rows);
        text
    }
}

/// A value as a line of the file.
pub(super) fn line(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default() + "\n"
}
