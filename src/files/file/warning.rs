//! Warnings about a file that can be used, with their lines.

use crate::file::locate::{Document, DocumentStep};
use crate::file::problem::render;
use crate::file::text::is_json;
use annotate_snippets::Level;
use itertools::Itertools;
use std::fmt::Display;
use std::ops::Range;
use thiserror::Error;

/// The doubtful value.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[allow(
    missing_docs,
    reason = "the wording of each variant says what its fields are"
)]
pub enum WarningKind {
    #[error("the name is empty; give one, because every answer begins with it")]
    NoName,
    #[error(
        "the id \"{id}\" has characters that reverse the order of letters; answers spell them out; remove them to show the id as it is read"
    )]
    TurnsLetters { id: String },
    #[error(
        "the mechanism is {across} m across, because lengths without a unit are in metres; add length_unit = \"mm\" if they are millimetres"
    )]
    ForgottenUnit { across: String },
    #[error("the mechanism is {across} m across; check that length_unit = \"{unit}\" is correct")]
    OddSize { across: String, unit: &'static str },
    #[error(
        "joints \"{first}\" and \"{second}\" are {apart} {unit} apart in a mechanism of {across} {unit}; give both the same point if they should coincide"
    )]
    NearlyOnePlace {
        first: String,
        second: String,
        apart: String,
        across: String,
        unit: &'static str,
    },
    #[error(
        "coordinates look measured or rounded: {what}; if the exact values are known, write them in quotes, such as \"sqrt(3)/2\" or \"cos(36deg)\"; otherwise give their uncertainty in a [tolerance] table"
    )]
    Measured { what: String },
    #[error(
        "state {state}: the idealised geometry gives {meant}, and the rounded digits as written give {written}; write roots or expressions such as \"sqrt(3)/2\", or more digits{understood}"
    )]
    Meant {
        understood: String,
        state: String,
        meant: String,
        written: String,
    },
    #[error("state {state}: {what}")]
    Undecided { state: String, what: String },
    #[error(
        "the second axes of {joints} use the default, which depends on the file's x, y and z; the same mechanism rotated in space has other axes; write them out, such as reference = {reference} at {first}"
    )]
    DefaultReference {
        joints: String,
        first: String,
        reference: String,
    },
    #[error(
        "nearly special: {what}; make them exact if this is intended, or give their uncertainty in a [tolerance] table"
    )]
    NearlySpecial { what: String },
    #[error(
        "the ratio {ratio} of {coupling} is a decimal, known to within {half}; write ratio = \"{fraction}\" if that is intended, or another fraction"
    )]
    DoubtedRatio {
        coupling: String,
        ratio: String,
        half: String,
        fraction: String,
    },
    #[error(
        "the pitch {pitch} of joint \"{joint}\" is a decimal close to that of a simple lead; write lead = \"{lead}\" instead if that is intended"
    )]
    DoubtedPitch {
        joint: String,
        pitch: String,
        lead: String,
    },
    #[error(
        "no loop is closed in any state, so nothing can be redundant; add the joints that close a loop"
    )]
    NoContour,
    #[error(
        "no loop passes through {joints}; their freedoms add to the mobility, and none of their constraints is redundant; add the joint that closes a loop if it is missing"
    )]
    OpenChain { joints: String },
    #[error(
        "clamped part \"{link}\" has a single joint in state {state}; add the other contact that clamps it"
    )]
    Dangling { link: String, state: String },
    #[error(
        "clamped part \"{link}\" is present in the free state; give its joints a state, such as state = \"clamped\""
    )]
    ObjectAlwaysThere { link: String },
    #[error(
        "joint \"{joint}\" is fixed in every state; merge the links \"{first}\" and \"{second}\", or give the joint a state"
    )]
    AlwaysFixed {
        joint: String,
        first: String,
        second: String,
    },
    #[error("joints \"{first}\" and \"{second}\" are identical; remove one")]
    Twin { first: String, second: String },
    #[error(
        "this contour follows from the others of its state and is ignored; remove it or give another"
    )]
    DependentContour,
    #[error(
        "option \"{option}\" is never used, because it would block the motion of every joint that it could replace; remove it"
    )]
    UselessOption { option: String },
    #[error(
        "the {what} of option \"{option}\" is not given and is taken along {along} at {joints}; write a table with `{key}` if another is intended: {{ type = \"{option}\", {key} = [...] }}"
    )]
    Guessed {
        option: String,
        what: &'static str,
        along: &'static str,
        key: &'static str,
        joints: String,
    },
    #[error(
        "no joint allows an unloading joint, so this list has no effect; write unloading = true at a joint"
    )]
    UnloadingNowhere,
    #[error(
        "joint \"{joint}\" allows unloading joints, but [search] lists none; add unloading = [\"spherical\"] there"
    )]
    UnloadingOfNothing { joint: String },
    #[error(
        "joint \"{joint}\" forbids \"{option}\", which is not an option of that joint; remove it, or correct the name"
    )]
    ForbidsNothing { joint: String, option: String },
    #[error(
        "joint \"{joint}\" has the freedoms {freedoms}, and the file does not state which one is driven; write drive = \"{taken}\" if it is the one that redesigns keep now, or name another"
    )]
    DriveUnnamed {
        joint: String,
        freedoms: String,
        taken: &'static str,
    },
    #[error("{what}")]
    Drives { what: String },
    #[error("no joint is a drive, so {what} has nothing to move; mark one with drive = true")]
    NoDrive { what: &'static str },
    #[error(
        "no link has the role \"output\", so every link counts as an output and no motion counts as idle; mark the working link with role = \"output\""
    )]
    NoOutput,
    #[error("no link has a mass, so gravity has no effect; add mass and centre to the links")]
    GravityAlone,
    #[error(
        "masses have no effect without gravity or drive_speed; add gravity = [0, 0, -9.81] to [workload]"
    )]
    MassAlone,
    #[error(
        "the ranking uses {term}, but nothing loads the mechanism; add forces, moments, or masses with gravity"
    )]
    RankingUnloaded { term: &'static str },
    #[error(
        "the file states {key} = {stated} in state {state}, but the analysis finds {found}; correct the figure, or delete [[expected]] if the mechanism differs from the published one"
    )]
    Stale {
        key: &'static str,
        state: String,
        stated: i64,
        found: i64,
    },
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
#[derive(Debug, Clone)]
pub struct Warning {
    /// The doubtful value.
    pub kind: WarningKind,
    /// Bytes of the text it concerns, where known.
    pub span: Option<Range<usize>>,
}

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
    /// Adds a warning about the item at a path of the file.
    pub fn add(&mut self, path: &[DocumentStep], kind: WarningKind) {
        let document = Document::new(&self.text, is_json(&self.file));
        let span = document.and_then(|d| d.span(path));
        let at = |d: &Warning| d.span.as_ref().map_or(0, |s| s.start);
        self.warnings.push(Warning { kind, span });
        self.warnings.sort_by_key(at);
    }

    /// Renders the warnings with their lines, for a terminal.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let one = |d: &Warning| {
            let message = d.kind.to_string();
            let span = d.span.clone();
            render(
                Level::WARNING,
                colour,
                &self.file,
                &self.text,
                span,
                &message,
            )
        };
        self.warnings.iter().map(one).join("\n")
    }
}
