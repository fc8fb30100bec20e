//! What can be wrong with a robot description, in words that name the element and the remedy.

use crate::file::problem::{ImportError, ProblemKind};
use std::ops::Range;
use thiserror::Error;

/// What is wrong.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(
    missing_docs,
    reason = "the wording of each variant says what its fields are"
)]
pub(crate) enum RobotProblem {
    #[error(
        "the file has {bytes} bytes, more than the {limit} allowed; remove what is not kinematics"
    )]
    TooLarge { bytes: usize, limit: usize },
    #[error("the file is not UTF-8 text (byte {at}); save it as UTF-8")]
    NotUtf8 { at: usize },
    #[error("{message}; the file is not well-formed XML")]
    Xml { message: String },
    #[error("the file declares entities; expand them first, for example with `xmllint --noent`")]
    Entities,
    #[error("elements are nested more than {limit} deep; flatten the file")]
    TooDeep { limit: usize },
    #[error("more than {limit} {what}; remove what is not kinematics")]
    TooMany { what: &'static str, limit: usize },
    #[error("the root element is <{found}>; {known} can be read")]
    Format { found: String, known: String },
    #[error("{element} has no {what}; add it")]
    Missing { element: String, what: String },
    #[error("{what} of {element} is \"{found}\"; {want}")]
    BadValue {
        element: String,
        what: String,
        found: String,
        want: String,
    },
    #[error("{element} has the unknown {what} \"{word}\"; known: {known}")]
    UnknownWord {
        element: String,
        what: &'static str,
        word: String,
        known: String,
    },
    #[error("{element} names the {what} \"{name}\", which there is not; {known}")]
    UnknownName {
        element: String,
        what: &'static str,
        name: String,
        known: String,
    },
    #[error("{element} is there twice; names must be unique")]
    Duplicate { element: String },
    #[error("{element} cannot be mapped: {why}; {remedy}")]
    Unsupported {
        element: String,
        why: String,
        remedy: String,
    },
    #[error("{message}")]
    Whole { message: String },
    #[error(
        "nothing can move: all {links} links are rigidly joined; there is no mechanism to analyse"
    )]
    Rigid { links: usize },
}

impl RobotProblem {
    /// The problem with its place.
    pub(crate) fn at(self, file: &str, text: &str, span: Option<Range<usize>>) -> ImportError {
        let kind = match self {
            RobotProblem::Rigid { links } => ProblemKind::Rigid { links },
            other => ProblemKind::Syntax {
                message: other.to_string(),
            },
        };
        kind.at(file, text, span)
    }
}

/// A list of names for a message, cut where it is long.
pub(crate) fn known<'a>(what: &str, names: impl Iterator<Item = &'a str>) -> String {
    let all: Vec<&str> = names.collect();
    if all.is_empty() {
        return format!("there are no {what}");
    }
    let shown = all.iter().take(20).copied().collect::<Vec<_>>().join(", ");
    let more = if all.len() > 20 { ", ..." } else { "" };
    format!("{what}: {shown}{more}")
}

/// Why a mechanism cannot be written in a format.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The format has no such joint.
    #[error("joint \"{joint}\" of type {kind} cannot be said in {format}; {remedy}")]
    Joint {
        /// The joint.
        joint: String,
        /// Its type.
        kind: String,
        /// The format.
        format: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// The format is written only of files that were read in it.
    #[error(
        "a mechanism alone cannot be written for {format}: give a document of it, whose joints get other types"
    )]
    Own {
        /// The format.
        format: &'static str,
    },
    /// No such format is written.
    #[error("unknown format \"{word}\"; known: {known}")]
    Unknown {
        /// The word for it.
        word: String,
        /// The words known.
        known: String,
    },
    /// The TOML writer failed.
    #[error("the mechanism cannot be written as TOML: {0}; report this with the file")]
    Toml(#[from] toml::ser::Error),
}
