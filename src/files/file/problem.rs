//! Problems of a file, in messages that name the item and the remedy.

use crate::file::locate::{Document, DocumentPath};
use crate::format::did_you_mean;
use crate::model::joint_type::JointType;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use itertools::Itertools;
use std::fmt::{self, Display};
use std::ops::Range;
use thiserror::Error;

/// A problem or warning, as a message that ends with the remedy. Kinds that callers distinguish have separate variants.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[allow(
    missing_docs,
    reason = "the wording of each variant says what its fields are"
)]
pub enum ProblemKind {
    #[error("{0}")]
    Message(String),
    #[error(
        "link \"{link}\" is not connected to the frame in state {state}; add the missing joint, or remove the link"
    )]
    Disconnected { link: String, state: String },
    #[error("link \"{link}\" has no joint in any state; connect it or remove it")]
    Unused { link: String },
    #[error(
        "option \"{option}\" of joint \"{joint}\" blocks a motion of the original {present} joint; every option must allow at least the original motion"
    )]
    LosesMotion {
        joint: String,
        option: String,
        present: String,
    },
    #[error(
        "nothing can move: all {links} links are rigidly joined; there is no mechanism to analyse"
    )]
    Rigid { links: usize },
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

impl<M: Into<String>> From<M> for ProblemKind {
    fn from(message: M) -> ProblemKind {
        ProblemKind::Message(message.into())
    }
}

impl ProblemKind {
    /// Returns the error of a file that has only this problem, at the given place.
    pub(crate) fn in_file(self, file: &str, text: &str, span: Option<Range<usize>>) -> ImportError {
        ImportError {
            file: file.to_owned(),
            text: text.to_owned(),
            problems: vec![Problem { kind: self, span }],
        }
    }
}

/// A problem or warning and the path of the item it concerns.
pub(crate) type Finding = (DocumentPath, ProblemKind);

/// A problem or warning and its place in a text.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The problem or warning.
    pub kind: ProblemKind,
    /// Bytes of the text it concerns, if known.
    pub span: Option<Range<usize>>,
}

impl Problem {
    /// Locates what was found at the paths of a text, in its order.
    pub(crate) fn locate_all(text: &str, json: bool, found: Vec<Finding>) -> Vec<Problem> {
        let document = Document::parse(text, json).ok();
        let span = |path: &DocumentPath| document.as_ref().and_then(|d| d.find_span(path));
        let located = |(path, kind)| Problem {
            span: span(&path),
            kind,
        };
        let mut all: Vec<Problem> = found.into_iter().map(located).collect();
        all.sort_by_key(|p| p.span.as_ref().map_or(usize::MAX, |s| s.start));
        all
    }

    /// Renders the message with its line, for a terminal; what follows a semicolon is the remedy.
    pub(crate) fn render(
        &self,
        level: Level<'static>,
        colour: bool,
        file: &str,
        text: &str,
    ) -> String {
        let renderer = if colour {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        let message = self.kind.to_string();
        let span = self.span.clone();
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
            None => (message.as_str(), None),
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
}

/// A file that could not be used, with every problem found.
///
/// # Examples
/// ```
/// use ozols::file::text::mechanism_from_str;
/// let text = ozols::builtin::text("four-bar").unwrap_or_default().replace("\"revolute\"", "\"revolt\"");
/// let why = mechanism_from_str("mine.toml", &text).expect_err("there is no such type");
/// assert_eq!(why.problems.len(), 4); // Each of the four joints is named, with a remedy.
/// assert!(why.render(false).contains("revolute"));
/// ```
#[derive(Debug, Clone)]
pub struct ImportError {
    /// Name of the file.
    pub file: String,
    /// Its text; empty if it could not be read as text.
    pub text: String,
    /// The problems, in order of the file if known.
    pub problems: Vec<Problem>,
}

impl ImportError {
    /// Returns the problems of a text with their places there, in its order.
    pub(crate) fn with_places(
        file: &str,
        text: &str,
        json: bool,
        found: Vec<Finding>,
    ) -> ImportError {
        ImportError {
            file: file.to_owned(),
            text: text.to_owned(),
            problems: Problem::locate_all(text, json, found),
        }
    }

    /// Returns true if the only problem is that nothing can move.
    ///
    /// # Examples
    /// ```
    /// use ozols::file::text::mechanism_from_str;
    /// let why = mechanism_from_str("mine.toml", "name = 3").expect_err("a name is text");
    /// assert!(!why.is_rigid()); // The problem is another one.
    /// ```
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        let rigid = |p: &Problem| matches!(p.kind, ProblemKind::Rigid { .. });
        !self.problems.is_empty() && self.problems.iter().all(rigid)
    }

    /// Renders the problems with their lines, for a terminal.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let one = |p: &Problem| p.render(Level::ERROR, colour, &self.file, &self.text);
        self.problems.iter().map(one).collect::<Vec<_>>().join("\n")
    }
}

/// Returns line and column of a byte of a text, both from 1.
pub(crate) fn line_and_column(text: &str, at: usize) -> [usize; 2] {
    let before = text.get(..at.min(text.len())).unwrap_or("");
    let last = before.rsplit('\n').next().unwrap_or("");
    let line = before.matches('\n').count() + 1;
    [line, last.chars().count() + 1]
}

impl Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, p) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            match &p.span {
                Some(s) => {
                    let [line, column] = line_and_column(&self.text, s.start);
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
pub(crate) fn suggest_word(word: &str, known: &str) -> String {
    let trade = JointType::TRADE_NAMES.map(|(name, _)| name);
    let types = known.contains(JointType::Revolute.name());
    let known = known.split(", ").chain(trade.into_iter().filter(|_| types));
    match did_you_mean::nearest_words(word, known).first() {
        Some(near) => format!("did you mean {near}? "),
        None => String::new(),
    }
}

/// The warnings about a file.
#[derive(Debug, Clone)]
pub struct Warnings {
    /// Name of the file.
    pub file: String,
    /// Its text.
    pub text: String,
    /// The warnings, in order of the file if known.
    pub warnings: Vec<Problem>,
}

impl Warnings {
    /// Adds warnings about the items at some paths of the file.
    pub fn add(&mut self, found: Vec<Finding>) {
        let found = Problem::locate_all(&self.text, is_json(&self.file), found);
        self.warnings.extend(found);
        self.warnings
            .sort_by_key(|d| d.span.as_ref().map_or(0, |s| s.start));
    }

    /// Renders the warnings with their lines, for a terminal.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let one = |d: &Problem| d.render(Level::WARNING, colour, &self.file, &self.text);
        self.warnings.iter().map(one).join("\n")
    }
}

/// Returns true if a file of this name is JSON.
pub(crate) fn is_json(name: &str) -> bool {
    std::path::Path::new(name)
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("json"))
}
