//! Warnings about a file that can be used, with the lines they stand on.

use crate::file::locate::{Document, DocumentStep};
use crate::file::problem::render;
use crate::file::text::is_json;
use annotate_snippets::Level;
use itertools::Itertools;
use std::fmt::Display;
use std::ops::Range;
use thiserror::Error;

/// What is doubtful.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[allow(
    missing_docs,
    reason = "the wording of each variant says what its fields are"
)]
pub enum WarningKind {
    #[error("the name is empty; give one, since every answer begins with it")]
    NoName,
    #[error(
        "the id \"{id}\" has characters that turn the order of letters round; answers spell them out, and without them it reads as it is written"
    )]
    TurnsLetters { id: String },
    #[error(
        "the joints are {across} m across, as lengths are metres where no unit stands; add length_unit = \"mm\" if they are millimetres"
    )]
    ForgottenUnit { across: String },
    #[error("the joints are {across} m across; see whether length_unit = \"{unit}\" is meant")]
    OddSize { across: String, unit: &'static str },
    #[error(
        "joints \"{first}\" and \"{second}\" are {apart} {unit} apart in a mechanism {across} {unit} across; give both the same point if they are meant to meet"
    )]
    NearlyOnePlace {
        first: String,
        second: String,
        apart: String,
        across: String,
        unit: &'static str,
    },
    #[error(
        "coordinates look measured or rounded: {what}; write exact ones in quotes, such as \"sqrt(3)/2\" or \"cos(36deg)\", where they are known (else a [tolerance] table says how far they may be off)"
    )]
    Measured { what: String },
    #[error(
        "state {state}: {meant} is meant, and {written} is what the rounded digits say as written; write roots or expressions such as \"sqrt(3)/2\", or more digits{understood}"
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
        "the second axes of {joints} are left to the default, which goes by the file's x, y and z: the same mechanism turned in space has others; write them out, such as reference = {reference} at {first}"
    )]
    DefaultReference {
        joints: String,
        first: String,
        reference: String,
    },
    #[error(
        "nearly special: {what}; make them so exactly if they are meant to be, or say how far they may be off in a [tolerance] table"
    )]
    NearlySpecial { what: String },
    #[error(
        "the ratio {ratio} of {coupling} is a decimal, known to within {half}; write ratio = \"{fraction}\" if that is meant, or another fraction"
    )]
    DoubtedRatio {
        coupling: String,
        ratio: String,
        half: String,
        fraction: String,
    },
    #[error(
        "the pitch {pitch} of joint \"{joint}\" is a decimal, all but that of a simple lead; write lead = \"{lead}\" in its place if that is meant"
    )]
    DoubtedPitch {
        joint: String,
        pitch: String,
        lead: String,
    },
    #[error(
        "no contour is closed in any state; nothing can be redundant without one: add the joints that close it"
    )]
    NoContour,
    #[error(
        "no contour passes through {joints}; freedoms there add to the mobility, and no constraint there is redundant: add the joint that closes one if it is missing"
    )]
    OpenChain { joints: String },
    #[error(
        "object \"{link}\" has a single joint in state {state}; add the other contact that clamps it"
    )]
    Dangling { link: String, state: String },
    #[error(
        "object \"{link}\" is there in the free state; give its joints a state, such as state = \"clamped\""
    )]
    ObjectAlwaysThere { link: String },
    #[error(
        "joint \"{joint}\" is fixed in every state; make one link of \"{first}\" and \"{second}\", or give it a state"
    )]
    AlwaysFixed {
        joint: String,
        first: String,
        second: String,
    },
    #[error("joints \"{first}\" and \"{second}\" are the same joint twice; remove one")]
    Twin { first: String, second: String },
    #[error(
        "this contour follows from the others of its state, and is passed over; remove it or name another"
    )]
    DependentContour,
    #[error(
        "no joint can take the option \"{option}\", as it does not allow their present motion; remove it"
    )]
    UselessOption { option: String },
    #[error(
        "the {what} of option \"{option}\" is taken along {along} at {joints}, as nobody states it; write a table with `{key}` if another is meant: {{ type = \"{option}\", {key} = [...] }}"
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
        "joint \"{joint}\" forbids \"{option}\", which is not an option of that joint; remove it, or correct the word"
    )]
    ForbidsNothing { joint: String, option: String },
    #[error(
        "joint \"{joint}\" has the freedoms {freedoms}, and the file does not say which one is driven; write drive = \"{taken}\" if it is the one that redesigns keep today, or name another"
    )]
    DriveUnnamed {
        joint: String,
        freedoms: String,
        taken: &'static str,
    },
    #[error("no joint is a drive, so {what} has nothing to move; mark one: drive = true")]
    NoDrive { what: &'static str },
    #[error(
        "no link has the role \"output\", so that each counts as one, and no motion as idle; mark the working link: role = \"output\""
    )]
    NoOutput,
    #[error("no link has a mass, so gravity has no effect; add mass and centre to the links")]
    GravityAlone,
    #[error(
        "masses have no effect without gravity or drive_speed; add gravity = [0, 0, -9.81] to [workload]"
    )]
    MassAlone,
    #[error(
        "the ranking asks for {term}, but nothing loads the mechanism; add forces, moments, or masses with gravity"
    )]
    RankingUnloaded { term: &'static str },
    #[error(
        "the file says {key} = {stated} in state {state}, and the analysis finds {found}; correct the figure, or delete [[expected]] where the mechanism is no longer the published one"
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

/// A warning and where it stands.
#[derive(Debug, Clone)]
pub struct Warning {
    /// What is doubtful.
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

    /// The warnings with the lines they stand on, for a terminal.
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
