//! Warnings about a file that can be used, with their lines.

use crate::file::locate::DocumentPath;
use crate::file::problem::Located;
use crate::file::text::is_json;
use annotate_snippets::Level;
use itertools::Itertools;
use std::fmt::Display;
use thiserror::Error;

/// What is doubtful, in words that end with the remedy. What a program tells apart has a variant of its own.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[allow(
    missing_docs,
    reason = "the wording of each variant says what its fields are"
)]
pub enum WarningKind {
    #[error("{0}")]
    Message(String),
    #[error(
        "nearly special: {what}; make them exact if this is intended, or give their uncertainty in a [tolerance] table"
    )]
    NearlySpecial { what: String },
    #[error(
        "no loop is closed in any state, so nothing can be redundant; add the joints that close a loop"
    )]
    NoContour,
    #[error(
        "no loop passes through {joints}; their freedoms add to the mobility, and none of their constraints is redundant; add the joint that closes a loop if it is missing"
    )]
    OpenChain { joints: String },
    #[error(
        "option \"{option}\" is never used, because it would block the motion of every joint that it could replace; remove it"
    )]
    UselessOption { option: String },
    #[error(
        "no link has the role \"output\", so every link counts as an output and no motion counts as idle; mark the working link with role = \"output\""
    )]
    NoOutput,
}

impl<M: Into<String>> From<M> for WarningKind {
    fn from(message: M) -> WarningKind {
        WarningKind::Message(message.into())
    }
}

/// Returns the first `most` items of a list as text, with the number of further items.
pub(crate) fn first_of(all: &[impl Display], most: usize) -> String {
    let more = match all.len().saturating_sub(most) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    format!("{}{more}", all.iter().take(most).join(", "))
}

/// A warning and its place.
pub type Warning = Located<WarningKind>;

/// The warnings about a file.
#[derive(Debug, Clone)]
pub struct Warnings {
    /// Name of the file.
    pub file: String,
    /// Its text.
    pub text: String,
    /// They, in order of the file where known.
    pub warnings: Vec<Warning>,
}

impl Warnings {
    /// Returns the warnings about the items at some paths of a file.
    pub(crate) fn new(name: &str, text: &str, found: Vec<(DocumentPath, WarningKind)>) -> Warnings {
        let mut out = Warnings {
            file: name.to_owned(),
            text: text.to_owned(),
            warnings: Vec::new(),
        };
        out.add(found);
        out
    }

    /// Adds warnings about the items at some paths of the file.
    pub fn add(&mut self, found: Vec<(DocumentPath, WarningKind)>) {
        let found = Located::all(&self.text, is_json(&self.file), found);
        self.warnings.extend(found);
        self.warnings
            .sort_by_key(|d| d.span.as_ref().map_or(0, |s| s.start));
    }

    /// Renders the warnings with their lines, for a terminal.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let one = |d: &Warning| d.render(Level::WARNING, colour, &self.file, &self.text);
        self.warnings.iter().map(one).join("\n")
    }
}
