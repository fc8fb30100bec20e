//! Mechanism files: one schema for TOML and JSON, read into a validated mechanism with every problem pointed at, written
//! back, looked over, changed with their comments kept, and made into templates.

pub mod costs;
mod digits;
#[doc(hidden)]
pub mod disk;
mod doubted;
pub mod edit;
#[doc(hidden)]
#[doc(hidden)]
mod lengths;
pub mod lint;
pub mod locate;
pub mod loose;
pub mod problem;
pub mod read;
mod rounding;
pub mod schema;
pub mod template;
pub mod text;
pub mod warning;
pub mod write;

use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::geom::expr::{Expr, ExprError};
use std::collections::{BTreeMap, BTreeSet};

/// A problem and the path of the item it concerns.
pub(crate) type Finding = (Vec<DocumentStep>, ProblemKind);

/// Most problems that are told; a file of a few megabytes can hold a hundred thousand, and each is looked up and drawn.
pub(crate) const TOLD: usize = 100;

/// Problems found so far, with where they stand: the first of them, and how many more there are. They are found where
/// expressions are read, so this knows the numbers that have names, too.
#[derive(Default)]
pub(crate) struct Findings {
    told: Vec<Finding>,
    more: usize,
    /// What the file's parameters stand for.
    names: BTreeMap<String, Expr>,
    /// Those that an expression has.
    used: BTreeSet<String>,
}

impl Findings {
    /// From now on these are numbers with names.
    pub(crate) fn know(&mut self, names: BTreeMap<String, Expr>) {
        self.names = names;
    }

    /// The value of an expression; where `pi_is_a_number`, outside of angles, too.
    pub(crate) fn expression(
        &mut self,
        text: &str,
        pi_is_a_number: bool,
    ) -> Result<Expr, ExprError> {
        let (names, used) = (&self.names, &mut self.used);
        Expr::with_names(text, pi_is_a_number, &mut |word| {
            let found = names.get(word)?;
            used.insert(word.to_owned());
            Some(found.clone())
        })
    }

    /// Names that no expression had so far.
    pub(crate) fn unused(&self) -> Vec<String> {
        let all = self.names.keys().filter(|n| !self.used.contains(*n));
        all.cloned().collect()
    }

    /// The names there are.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.names.keys().map(String::as_str)
    }

    pub(crate) fn add(&mut self, path: &[DocumentStep], kind: ProblemKind) {
        if self.told.len() < TOLD {
            self.told.push((path.to_vec(), kind));
        } else {
            self.more += 1;
        }
    }

    /// The entries of a list, which has at most `limit`; the first of them where it has more.
    pub(crate) fn at_most<'e, T>(
        &mut self,
        limit: usize,
        list: &'e [T],
        what: &'static str,
        path: &[DocumentStep],
    ) -> &'e [T] {
        let count = list.len();
        if count > limit {
            self.add(path, ProblemKind::TooMany { what, count, limit });
        }
        &list[..count.min(limit)]
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.told.len() + self.more
    }

    /// Those that are told.
    pub(crate) fn told(mut self) -> Vec<Finding> {
        if self.more > 0 {
            let count = self.more;
            self.told.push((Vec::new(), ProblemKind::More { count }));
        }
        self.told
    }

    /// What was made of the file, if nothing is wrong with it.
    pub(crate) fn unless<T>(self, made: T) -> Result<T, Vec<Finding>> {
        if self.count() == 0 {
            Ok(made)
        } else {
            Err(self.told())
        }
    }
}
