//! Options of an import, and its mapped, approximated and dropped elements.

use crate::file::problem::{ImportError, ProblemKind};
use crate::format::{count_noun, first_of};
use itertools::Itertools;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use thiserror::Error;

/// Options for reading a description.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// Name and bytes of a file of loop closures.
    #[serde(skip)]
    pub loops: Option<(String, Vec<u8>)>,
    /// Values of joints, in radians and metres, one for each freedom.
    pub pose: Vec<(String, Vec<f64>)>,
    /// Hang a robot without a fixed link on the world by a joint of six freedoms.
    pub floating: bool,
    /// SDF drawn in parts: every joint puts the frame that is its parent onto its child. CAD assemblies: each part keeps its own
    /// frame of a joint, and joints that are open are closed.
    pub assemble: bool,
    /// Accept loops that do not close.
    pub open: bool,
    /// Folders for `model://`, searched in order. Files that are included with `../` may also be within them.
    pub models: Vec<std::path::PathBuf>,
    /// The assembly of a CAD document that is read, in place of the one with most joints.
    pub assembly: Option<String>,
    /// The link to be the frame, in place of the root.
    pub frame: Option<String>,
    /// The links to be outputs, in place of the end links.
    pub outputs: Vec<String>,
}

/// Reads the bytes of an included file by its name.
pub type Reader<'a> = &'a dyn Fn(&str) -> std::io::Result<Vec<u8>>;

/// Names shown of each kind of dropped element.
const SHOWN: usize = 4;

/// The omissions of every import.
pub const KINEMATICS: &str =
    "Only the kinematics are read: no masses, shapes, limits or actuators.";

/// The report on the import of a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Elements mapped approximately, each with its treatment.
    pub approximated: Vec<String>,
    /// Approximations that are guesses or omissions. They may constrain or couple something, so figures are those
    /// of the file as read.
    pub assumed: Vec<String>,
    /// Parts, joints and documents that are switched off, loose or not read: their names by kind.
    pub dropped: BTreeMap<String, Vec<String>>,
    /// Maximum number of rows of the omitted couplings and joints.
    pub left_out: usize,
    /// Freedoms as a CAD program counts them, for an assembly: 6 a moving part, less all constraints of joints, which is W minus σ.
    pub cad_freedoms: Option<i64>,
    /// Differences from the drawn pose: joints moved, loops left open, floating bases.
    pub moved: Vec<String>,
    /// Links and joints of the mechanism.
    pub size: (usize, usize),
    /// Links treated as outputs, and whether that was requested.
    pub outputs: (Vec<String>, bool),
}

impl Report {
    pub(crate) fn add_approximation(&mut self, element: &str, what: impl Into<String>) {
        self.approximated
            .push(format!("{element}: {}", what.into()));
    }

    /// Records an assumption that the file does not state.
    pub(crate) fn add_assumption(&mut self, element: &str, what: impl Into<String>) {
        let what = what.into();
        self.assumed.push(format!("{element}: {what}"));
        self.add_approximation(element, what);
    }

    /// Records an omitted coupling or joint, with its largest possible number of rows.
    pub(crate) fn leave_out(&mut self, element: &str, rows: usize, what: impl Into<String>) {
        self.left_out += rows;
        self.add_assumption(element, what);
    }

    pub(crate) fn drop_element(&mut self, kind: &str, name: &str) {
        let names = self.dropped.entry(kind.to_owned()).or_default();
        names.push(name.to_owned());
    }

    /// Returns the report as text.
    #[must_use]
    pub fn text(&self, file: &str) -> String {
        let (links, joints) = self.size;
        let (links, joints) = (count_noun(links, "link"), count_noun(joints, "joint"));
        let mut out = format!("{file}: {links}, {joints}\n");
        for moved in &self.moved {
            write_line(&mut out, "pose", moved);
        }
        out.push_str(&self.list_doubts());
        for (kind, names) in &self.dropped {
            let what = format!("{} {kind} ({})", names.len(), first_of(names, SHOWN));
            write_line(&mut out, "dropped", &what);
        }
        let (names, asked) = &self.outputs;
        let hint = if *asked {
            ""
        } else {
            " (end effectors, ends of chains, a floating base; the option `working_link` chooses others)"
        };
        let shown = first_of(names, 8);
        write_line(&mut out, "output", &format!("{shown}{hint}"));
        out
    }

    /// Returns the reasons why the figures may differ from those of the description, a line each; empty if there are none.
    #[must_use]
    pub fn list_doubts(&self) -> String {
        let mut out = String::new();
        if let n @ 1.. = self.left_out {
            let rows = count_noun(n, "row");
            let what = format!("{rows}: W is up to {n} too high, σ may be too low");
            write_line(&mut out, "omitted", &what);
        }
        for what in &self.approximated {
            write_line(&mut out, "approximated", what);
        }
        out
    }
}

fn write_line(out: &mut String, head: &str, what: &str) {
    let _ = writeln!(out, "  {head:<13} {what}");
}

/// The result of reading a part of a description, or the first problem with it.
pub(crate) type Read<T> = Result<T, ImportError>;

/// A result, or a problem whose place is not known yet.
pub(crate) type Found<T> = Result<T, ProblemKind>;

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

pub(crate) fn missing_problem(element: &str, what: &str) -> ProblemKind {
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

/// Returns the problem that an element names an unknown thing, with at most 20 of the known names. `one` and `many` are its noun.
pub(crate) fn unknown_name(
    element: &str,
    [one, many]: [&str; 2],
    name: &str,
    known: impl IntoIterator<Item: AsRef<str>>,
) -> ProblemKind {
    let all: Vec<_> = known.into_iter().collect();
    let shown = all.iter().take(20).map(AsRef::as_ref).join(", ");
    let list = match all.len() {
        0 => format!("there are no {many}"),
        1..=20 => format!("{many}: {shown}"),
        _ => format!("{many}: {shown}, ..."),
    };
    syntax_problem(format!(
        "{element} names the {one} \"{name}\", which does not exist; {list}"
    ))
}

pub(crate) fn unsupported_problem(element: &str, why: &str, remedy: &str) -> ProblemKind {
    syntax_problem(format!("{element} cannot be mapped: {why}; {remedy}"))
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
    /// No format of this name can be written.
    #[error("unknown format \"{word}\"; known: {known}")]
    Unknown {
        /// The unknown word.
        word: String,
        /// The known words.
        known: String,
    },
    /// The loads, the ranking, the figures or the claims are not those of the file that the mechanism was read from.
    #[error(
        "the loads, the ranking, the figures or the claims were changed in code, or name what was renamed, and only those of a file can be written; change them in the file and read it again"
    )]
    Changed,
    /// The TOML writer failed.
    #[error("the mechanism cannot be written as TOML: {0}; report this with the file")]
    Toml(#[from] toml::ser::Error),
}
