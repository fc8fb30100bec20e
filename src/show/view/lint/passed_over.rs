//! Files that nothing can be said of but why: told in every format, so that those that can be looked at are not lost with them.

use crate::format::plain::line;
use serde::Serialize;
use serde_json::{Value, json};

/// A file that could not be looked at, or has nothing to be looked at.
#[derive(Debug, Clone, Serialize)]
pub struct PassedOver {
    /// Name of the file.
    pub file: String,
    /// Why, in a line.
    pub why: String,
    /// Whether nothing in it can move: then nothing is redundant, and nothing is wrong.
    pub rigid: bool,
}

impl PassedOver {
    /// Why a file is passed over.
    #[must_use]
    pub fn new(file: &str, why: &str, rigid: bool) -> PassedOver {
        let line = why.lines().next().unwrap_or_default();
        // The file stands in front of the line already: `FILE:3:7: why`, `FILE: why` or `FILE is no such thing`.
        let named = line.strip_prefix(file).and_then(|rest| {
            let of_place = rest.strip_prefix(':').map(str::trim_start);
            of_place.or_else(|| rest.strip_prefix(" is "))
        });
        PassedOver {
            file: file.to_owned(),
            why: named.unwrap_or(line).to_owned(),
            rigid,
        }
    }

    /// A line for people.
    #[must_use]
    pub fn text(&self) -> String {
        let (file, why) = (line(&self.file), line(&self.why));
        if self.rigid {
            format!("{file}: nothing is redundant: {why}\n")
        } else {
            format!("{file}: not looked at: {why}\n")
        }
    }
}

/// Tells of them beside the findings in JSON; nothing where there are none.
pub(super) fn in_json(out: &mut Value, all: &[PassedOver]) {
    if !all.is_empty() {
        out["passed_over"] = json!(all);
    }
}
