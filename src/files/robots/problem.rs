//! Problems of a robot description, in messages that name the element and the remedy.

use crate::file::problem::{ImportError, ProblemKind};
use itertools::Itertools;
use thiserror::Error;

/// The result of reading a part of a description, or the first problem with it.
pub(crate) type Read<T> = Result<T, ImportError>;

/// Returns a problem with the given message.
pub(crate) fn syntax_problem(message: impl Into<String>) -> ProblemKind {
    ProblemKind::from(message)
}

pub(crate) fn too_large(bytes: usize, limit: usize) -> ProblemKind {
    syntax_problem(format!(
        "the file has {bytes} bytes, more than the {limit} allowed; remove everything that is not kinematics"
    ))
}

pub(crate) fn too_deep(limit: usize) -> ProblemKind {
    syntax_problem(format!(
        "elements are nested more than {limit} deep; flatten the file"
    ))
}

pub(crate) fn too_many(what: &str, limit: usize) -> ProblemKind {
    syntax_problem(format!(
        "more than {limit} {what}; remove everything that is not kinematics"
    ))
}

pub(crate) fn missing(element: &str, what: &str) -> ProblemKind {
    syntax_problem(format!("{element} has no {what}; add it"))
}

pub(crate) fn bad_value(element: &str, what: &str, found: &str, want: &str) -> ProblemKind {
    syntax_problem(format!("{what} of {element} is \"{found}\"; {want}"))
}

pub(crate) fn unknown_word(element: &str, what: &str, word: &str, known: &str) -> ProblemKind {
    syntax_problem(format!(
        "{element} has the unknown {what} \"{word}\"; known: {known}"
    ))
}

/// Returns the problem that an element names something unknown. `known` lists the known names.
pub(crate) fn unknown_name(element: &str, what: &str, name: &str, known: &str) -> ProblemKind {
    syntax_problem(format!(
        "{element} names the {what} \"{name}\", which does not exist; {known}"
    ))
}

pub(crate) fn unsupported(element: &str, why: &str, remedy: &str) -> ProblemKind {
    syntax_problem(format!("{element} cannot be mapped: {why}; {remedy}"))
}

/// Returns a list of names for a message, with at most 20 of them.
pub(crate) fn known(what: &str, names: impl IntoIterator<Item: AsRef<str>>) -> String {
    let all: Vec<_> = names.into_iter().collect();
    if all.is_empty() {
        return format!("there are no {what}");
    }
    let shown = all.iter().take(20).map(AsRef::as_ref).join(", ");
    let more = if all.len() > 20 { ", ..." } else { "" };
    format!("{what}: {shown}{more}")
}

/// Why a mechanism cannot be written in a format.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The format has no such joint.
    #[error("{format} cannot represent joint \"{joint}\" of type {kind}; {remedy}")]
    Joint {
        /// The joint.
        joint: String,
        /// Its type.
        kind: String,
        /// The format.
        format: &'static str,
        /// The remedy.
        remedy: &'static str,
    },
    /// The format is written only of files that were read in it.
    #[error(
        "{format} cannot be written from a mechanism only; give a document in this format, whose joints get other types"
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
