//! Mechanism files: one schema for TOML and JSON. Files are read into a validated mechanism, with the place of every problem. They can be
//! written back, checked, changed with their comments kept, and made into templates.

pub mod builder;
#[doc(hidden)]
pub mod disk;
mod doubted;
pub mod edit;
pub mod lint;
pub mod locate;
pub mod loose;
mod prelude;
pub mod problem;
pub mod read;
pub mod schema;
pub mod template;
pub mod text;
pub mod write;

use crate::file::locate::DocumentPath;
pub(crate) use crate::file::problem::Finding;
use crate::file::problem::{ProblemKind, suggest_word};
use crate::geom::expr::{Expr, ExprError};
use itertools::Itertools;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;

/// Maximum number of reported problems. A file of a few megabytes can have a hundred thousand, and each is located and drawn.
pub(crate) const TOLD: usize = 100;

/// The problems found so far with their places: the first of them, and the number of further ones. Also the named numbers and the
/// states of the file, which its entries name.
#[derive(Default)]
pub(crate) struct Findings {
    told: RefCell<Vec<Finding>>,
    more: Cell<usize>,
    /// The doubtful values found so far.
    warned: RefCell<Vec<Finding>>,
    /// The values of the file's parameters.
    names: BTreeMap<String, Expr>,
    /// The names of the states, `free` first.
    pub(crate) states: Vec<String>,
    /// The parameters that an expression uses.
    pub(crate) used: RefCell<BTreeSet<String>>,
}

impl Findings {
    /// Sets the numbers that expressions know by name.
    pub(crate) fn set_parameters(&mut self, names: BTreeMap<String, Expr>) {
        self.names = names;
    }

    /// Returns the value of an expression. If `pi` is true, pi may be used outside of angles.
    pub(crate) fn parse_expression(&self, text: &str, pi: bool) -> Result<Expr, ExprError> {
        Expr::with_names(text, pi, &mut |word| {
            let found = self.names.get(word)?;
            self.used.borrow_mut().insert(word.to_owned());
            Some(found.clone())
        })
    }

    /// Returns the names of all parameters.
    pub(crate) fn parameter_names(&self) -> impl Iterator<Item = &str> {
        self.names.keys().map(String::as_str)
    }

    /// Reports parameters that no expression uses.
    pub(crate) fn tell_unused(&self) {
        let used = self.used.borrow();
        for name in self.parameter_names().filter(|n| !used.contains(*n)) {
            let at = self.key("parameter").key(name);
            at.add_problem(format!(
                "parameter \"{name}\" is never used; use it in an expression in quotes, such as \"2*{name}\", or remove it"
            ));
        }
    }

    /// Returns the place of the whole file.
    pub(crate) fn root_place(&self) -> Place<'_> {
        let path = DocumentPath::default();
        Place { path, out: self }
    }

    /// Returns the place of a key of the file.
    pub(crate) fn key(&self, key: &str) -> Place<'_> {
        self.root_place().key(key)
    }

    /// Returns the number of problems.
    pub(crate) fn problem_count(&self) -> usize {
        self.told.borrow().len() + self.more.get()
    }

    /// Returns the reported problems.
    pub(crate) fn into_findings(self) -> Vec<Finding> {
        let (mut told, count) = (self.told.into_inner(), self.more.get());
        if count > 0 {
            let more = format!("{count} more problems are not listed; correct those above first");
            told.push((DocumentPath::default(), more.into()));
        }
        told
    }

    /// Returns the result for the file, or the problems if there are any.
    pub(crate) fn finish<T>(self, made: T) -> Result<T, Vec<Finding>> {
        match self.problem_count() {
            0 => Ok(made),
            _ => Err(self.into_findings()),
        }
    }
}

/// A place in the file. Its methods read values and report problems with them.
#[derive(Clone)]
pub(crate) struct Place<'f> {
    path: DocumentPath,
    pub(crate) out: &'f Findings,
}

impl<'f> Place<'f> {
    /// Returns the place of a key of the table at this place.
    pub(crate) fn key(&self, key: &str) -> Place<'f> {
        let path = self.path.key(key);
        Place { path, ..*self }
    }

    /// Returns the place of a key itself, instead of its value.
    pub(crate) fn key_name(&self, key: &str) -> Place<'f> {
        let path = self.path.name(key);
        Place { path, ..*self }
    }

    /// Returns the place of an entry of the list at this place.
    pub(crate) fn entry_at(&self, i: usize) -> Place<'f> {
        let path = self.path.entry_at(i);
        Place { path, ..*self }
    }

    /// Returns the entries of the list at this place, each with its own place.
    pub(crate) fn each_entry<'e, T>(
        &self,
        list: &'e [T],
    ) -> impl Iterator<Item = (Place<'f>, &'e T)> + use<'f, 'e, T> {
        let (at, each) = (self.clone(), list.iter().enumerate());
        each.map(move |(i, e)| (at.entry_at(i), e))
    }

    /// Returns the first `limit` entries of the list at this place, each with its own place. Reports a longer list.
    pub(crate) fn first_entries<'e, T>(
        &self,
        limit: usize,
        list: &'e [T],
        what: &'static str,
    ) -> impl Iterator<Item = (Place<'f>, &'e T)> + use<'f, 'e, T> {
        self.count_within(limit, list.len(), what);
        self.each_entry(&list[..list.len().min(limit)])
    }

    /// Reports more items than a limit. Returns true if there are no more.
    pub(crate) fn count_within(&self, limit: usize, count: usize, what: &str) -> bool {
        if count > limit {
            self.add_problem(format!(
                "the file has {count} {what}, more than the {limit} allowed"
            ));
        }
        count <= limit
    }

    /// Reports a problem at this place.
    pub(crate) fn add_problem(&self, kind: impl Into<ProblemKind>) {
        let mut told = self.out.told.borrow_mut();
        if told.len() < TOLD {
            told.push((self.path.clone(), kind.into()));
        } else {
            self.out.more.set(self.out.more.get() + 1);
        }
    }

    /// Warns of a doubtful value at this place.
    pub(crate) fn warn(&self, kind: impl Into<ProblemKind>) {
        let warning = (self.path.clone(), kind.into());
        self.out.warned.borrow_mut().push(warning);
    }

    /// Reports an unknown word.
    pub(crate) fn add_unknown_word(
        &self,
        what: &str,
        word: &str,
        known: impl IntoIterator<Item: Display>,
    ) {
        self.add_problem(unknown_word(what, word, known));
    }

    /// Reports a value that is not allowed.
    pub(crate) fn add_bad_value(&self, what: &str, value: impl Display, allowed: &str) {
        self.add_problem(format!("{what} {value} is out of range; give {allowed}"));
    }

    /// Reports a key that needs another key or condition.
    pub(crate) fn add_missing_key(&self, key: &str, other: &str) {
        self.key(key).add_problem(format!("{key} needs {other}"));
    }

    /// Reports a key that cannot be combined with another key.
    pub(crate) fn add_excluded_key(&self, key: &str, other: &str) {
        self.key(key).add_problem(format!(
            "{key} and {other} exclude each other; keep one of them"
        ));
    }
}

/// Returns the problem of an unknown word, with the known ones.
pub(crate) fn unknown_word(
    what: &str,
    word: &str,
    known: impl IntoIterator<Item: Display>,
) -> ProblemKind {
    let known = known.into_iter().join(", ");
    let near = suggest_word(word, &known);
    format!("unknown {what} \"{word}\"; {near}known: {known}").into()
}
