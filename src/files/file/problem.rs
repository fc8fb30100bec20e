//! Problems of a file, in messages that name the item and the remedy.

use crate::file::locate::{Document, DocumentStep};
use crate::format::{did_you_mean, plural};
use crate::model::joint_type::JointType;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::fmt;
use std::ops::Range;
use thiserror::Error;

/// The problem.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[allow(
    missing_docs,
    reason = "the wording of each variant says what its fields are"
)]
pub enum ProblemKind {
    #[error(
        "the file has {bytes} bytes, more than the {limit} allowed; split it or remove everything that is not a mechanism"
    )]
    TooLarge { bytes: usize, limit: usize },
    #[error("the file is empty; `ozols schema` describes its contents")]
    Empty,
    #[error("the file is not UTF-8 text (byte {at}); save it as UTF-8")]
    NotUtf8 { at: usize },
    #[error("{message}")]
    Syntax { message: String },
    #[error("{what} id \"{id}\" is used twice; ids must be unique")]
    Duplicate { what: &'static str, id: String },
    #[error("an id must have 1 to 64 characters and no control characters, not {id:?}")]
    BadId { id: String },
    #[error("{key} contains the control character {found}; remove it")]
    Control { key: String, found: String },
    #[error("unknown link \"{id}\"; known links: {known}")]
    UnknownLink { id: String, known: String },
    #[error("unknown joint \"{id}\"; known joints: {known}")]
    UnknownJoint { id: String, known: String },
    #[error("unknown {what} \"{word}\"; {}known: {known}", suggestion(word, known))]
    UnknownWord {
        what: &'static str,
        word: String,
        known: String,
    },
    #[error("joint \"{joint}\" connects link \"{link}\" to itself; name two different links")]
    SelfLoop { joint: String, link: String },
    #[error(
        "link \"{link}\" is not connected to the frame in state {state}; add the missing joint, or remove the link"
    )]
    Disconnected { link: String, state: String },
    #[error("link \"{link}\" has no joint in any state; connect it or remove it")]
    Unused { link: String },
    #[error("the {what} of joint \"{joint}\" is zero; give a direction such as [0, 0, 1]")]
    ZeroVector { joint: String, what: &'static str },
    #[error("the reference of joint \"{joint}\" is parallel to its axis; give another direction")]
    ParallelReference { joint: String },
    #[error("{list} has {}; write {}", plural(*count, "value"), lengths(*least, *most))]
    Length {
        list: String,
        count: usize,
        least: usize,
        most: usize,
    },
    #[error("joint \"{joint}\" of type {kind} needs {what}")]
    Missing {
        joint: String,
        kind: String,
        what: &'static str,
    },
    #[error("joint \"{joint}\" of type {kind} takes no {what}; remove it")]
    Superfluous {
        joint: String,
        kind: String,
        what: &'static str,
    },
    #[error("joint \"{joint}\" names the freedom {freedom} twice; name it once")]
    RepeatedFreedom { joint: String, freedom: String },
    #[error("{message}")]
    BadNumber { message: String },
    #[error(
        "coordinate {value} is out of range; lengths may be 1e-40 to 1e12 in size; choose another length_unit"
    )]
    OutOfRange { value: String },
    #[error(
        "option \"{option}\" of joint \"{joint}\" blocks a motion of the original {present} joint; every option must allow at least the original motion"
    )]
    LosesMotion {
        joint: String,
        option: String,
        present: String,
    },
    #[error("joint \"{joint}\" has two options named \"{option}\"; rename one of them")]
    RepeatedOption { joint: String, option: String },
    #[error("{what} {value} is out of range; give {allowed}")]
    BadQuantity {
        what: &'static str,
        value: String,
        allowed: &'static str,
    },
    #[error("{key} needs {other}")]
    KeyNeeds {
        key: &'static str,
        other: &'static str,
    },
    #[error("{key} and {other} exclude each other; keep one of them")]
    KeyExcludes {
        key: &'static str,
        other: &'static str,
    },
    #[error(
        "the file has no [workload.{table}] table; `ozols show {example}` prints one to start from"
    )]
    NoWorkload {
        table: &'static str,
        example: &'static str,
    },
    #[error("link \"{link}\" has incomplete mass data; add {what}")]
    LinkNeeds { link: String, what: &'static str },
    #[error("no link has the role \"frame\"; mark the fixed link with role = \"frame\"")]
    NoFrame,
    #[error(
        "link \"{second}\" is a second frame after \"{first}\"; keep only one role = \"frame\""
    )]
    SecondFrame { first: String, second: String },
    #[error(
        "the joints of this contour do not form one closed loop; list them in order around the loop"
    )]
    OpenContour,
    #[error(
        "joint \"{joint}\" is coupled with itself; name two joints (for a rotation and a translation that are coupled use a helical joint)"
    )]
    CouplesItself { joint: String },
    #[error("joints \"{first}\" and \"{second}\" are coupled twice; keep one of the couplings")]
    CoupledTwice { first: String, second: String },
    #[error(
        "joints \"{first}\" and \"{second}\" are coupled but are not present in the same states; give both the same state"
    )]
    CouplesStates { first: String, second: String },
    #[error(
        "the ratio of the axes' lengths of joints \"{first}\" and \"{second}\" has no exact value; give both an axis of length 1"
    )]
    CouplingInexact { first: String, second: String },
    #[error(
        "the ratio of a coupling is zero, which would lock the second joint; give another ratio, or make that joint fixed"
    )]
    ZeroRatio,
    #[error(
        "joint \"{joint}\" of type {kind} has no freedom that can be coupled; couple translations and rotations about one axis (a spherical joint has no single axis)"
    )]
    NothingToCouple { joint: String, kind: String },
    #[error("joint \"{joint}\" has several freedoms; name the coupled one: {known}")]
    WhichFreedom { joint: String, known: String },
    #[error(
        "option \"{option}\" of joint \"{joint}\" does not keep the coupled freedom about the same axis; remove it"
    )]
    LosesCoupling { joint: String, option: String },
    #[error("joint \"{joint}\" has more than one image under {under}; name each joint once")]
    RepeatedImage { joint: String, under: &'static str },
    #[error(
        "a group of {count} joints under turn: write pairs for half a turn, or groups of three for a third, all of one kind"
    )]
    TurnGroup { count: usize },
    #[error("mirror and turn exclude each other; keep one of them")]
    TurnAndMirror,
    #[error(
        "joints \"{first}\" and \"{second}\" are not mirror images: in the plane that fits most pairs the image of \"{first}\" is {off} from \"{second}\"; correct their points and axes, or remove the pair"
    )]
    NoMirrorImage {
        first: String,
        second: String,
        off: String,
    },
    #[error("cost {value} must be a finite number from 0 to 1e6")]
    BadCost { value: String },
    #[error(
        "the closure matrix of state {state} would have {rows} rows and {columns} columns, more than {limit} entries; remove irrelevant parts, or move independent parts to separate files"
    )]
    TooEntangled {
        state: String,
        rows: usize,
        columns: usize,
        limit: usize,
    },
    #[error(
        "a parameter cannot be named {name:?}; use a letter followed by letters, digits or _, but not pi, deg, sqrt, cos, sin, tan or cot"
    )]
    BadParameter { name: String },
    #[error(
        "parameter \"{name}\" is never used; use it in an expression in quotes, such as \"2*{name}\", or remove it"
    )]
    UnusedParameter { name: String },
    #[error("the file has {count} {what}, more than the {limit} allowed")]
    TooMany {
        what: &'static str,
        count: usize,
        limit: usize,
    },
    #[error(
        "nothing can move: all {links} links are rigidly joined; there is no mechanism to analyse"
    )]
    Rigid { links: usize },
    #[error("{count} more problems are not listed; correct those above first")]
    More { count: usize },
}

impl ProblemKind {
    /// Returns the error of a file that has only this problem, at the given place.
    pub(crate) fn in_file(self, file: &str, text: &str, span: Option<Range<usize>>) -> ImportError {
        let (file, text) = (file.to_owned(), text.to_owned());
        let problems = vec![Problem { kind: self, span }];
        ImportError {
            file,
            text,
            problems,
        }
    }
}

/// Returns how many values a list may have, in words.
fn lengths(least: usize, most: usize) -> String {
    if least == most {
        format!("{}, no more and no fewer", plural(least, "value"))
    } else {
        format!("{least} to {}", plural(most, "value"))
    }
}

/// A problem and its place.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The problem.
    pub kind: ProblemKind,
    /// Bytes of the text it concerns, where known.
    pub span: Option<Range<usize>>,
}

/// A file that could not be used, with every problem found.
#[derive(Debug, Clone)]
pub struct ImportError {
    /// Name of the file.
    pub file: String,
    /// Its text; empty if it could not be read as text.
    pub text: String,
    /// The problems, in order of the file where known.
    pub problems: Vec<Problem>,
}

impl ImportError {
    /// Returns the problems of a text with their places there, in its order.
    pub(crate) fn located(
        file: &str,
        text: &str,
        json: bool,
        found: Vec<(Vec<DocumentStep>, ProblemKind)>,
    ) -> ImportError {
        let document = Document::new(text, json);
        let span = |path: &[_]| document.as_ref().and_then(|d| d.span(path));
        let problem = |(path, kind): (Vec<_>, _)| Problem {
            span: span(&path),
            kind,
        };
        let mut problems: Vec<Problem> = found.into_iter().map(problem).collect();
        problems.sort_by_key(|p| p.span.as_ref().map_or(usize::MAX, |s| s.start));
        let (file, text) = (file.to_owned(), text.to_owned());
        ImportError {
            file,
            text,
            problems,
        }
    }

    /// Returns line and column, from 1, of a byte.
    #[must_use]
    pub(crate) fn line_and_column(&self, at: usize) -> (usize, usize) {
        let before = self.text.get(..at.min(self.text.len())).unwrap_or("");
        let line = before.matches('\n').count() + 1;
        (
            line,
            before.rsplit('\n').next().unwrap_or("").chars().count() + 1,
        )
    }

    /// Returns true if the only problem is that nothing can move.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        let rigid = |p: &Problem| matches!(p.kind, ProblemKind::Rigid { .. });
        !self.problems.is_empty() && self.problems.iter().all(rigid)
    }

    /// Renders the problems with their lines, for a terminal.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let one = |p: &Problem| {
            let message = p.kind.to_string();
            let (file, text) = (&self.file, &self.text);
            render(Level::ERROR, colour, file, text, p.span.clone(), &message)
        };
        self.problems.iter().map(one).collect::<Vec<_>>().join("\n")
    }
}

/// Renders a message about a part of a file, given by its name and text, with its line; the text after a semicolon is the remedy.
pub(crate) fn render(
    level: Level<'static>,
    colour: bool,
    file: &str,
    text: &str,
    span: Option<Range<usize>>,
    message: &str,
) -> String {
    let renderer = if colour {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let Some(span) = span.filter(|s| !text.is_empty() && text.get(s.clone()).is_some()) else {
        let message = format!("{file}: {message}");
        let title = level.primary_title(message.as_str());
        return renderer.render(&[Group::with_title(title)]).to_string();
    };
    // A table reaches over many lines; its first is enough to find it.
    let end = text[span.clone()]
        .find('\n')
        .map_or(span.end, |n| span.start + n);
    let (message, help) = match message.split_once("; ") {
        Some((m, h)) => (m, Some(h)),
        None => (message, None),
    };
    let snippet = Snippet::source(text)
        .path(file)
        .annotation(AnnotationKind::Primary.span(span.start..end.max(span.start)));
    let title = level.primary_title(message).element(snippet);
    let group = match help {
        Some(h) => title.element(Level::HELP.message(h)),
        None => title,
    };
    renderer.render(&[group]).to_string()
}

impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, p) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            match &p.span {
                Some(s) => {
                    let (line, column) = self.line_and_column(s.start);
                    write!(f, "{}:{line}:{column}: {}", self.file, p.kind)?;
                }
                None => write!(f, "{}: {}", self.file, p.kind)?,
            }
        }
        Ok(())
    }
}

impl std::error::Error for ImportError {}

/// Returns "did you mean this? " for a word that is near to a known one, out of a list with commas; empty if none is near.
pub(crate) fn suggestion(word: &str, known: &str) -> String {
    let trade = JointType::TRADE_NAMES.map(|(name, _)| name);
    let types = known.contains(JointType::Revolute.name());
    let known = known.split(", ").chain(trade.into_iter().filter(|_| types));
    match did_you_mean::near(word, known).first() {
        Some(near) => format!("did you mean {near}? "),
        None => String::new(),
    }
}
