//! The table of what a conversion lost: a line a kind, with how many and an example.

use std::collections::BTreeMap;

/// What is lost of one kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LostKind {
    /// How many.
    pub count: usize,
    /// The first of them by name; nothing where none has one.
    pub example: Option<String>,
    /// What stands there in its place, or why there is nothing.
    pub why: String,
}

/// What is lost, by kind.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Lost {
    /// The kinds.
    pub kinds: BTreeMap<String, LostKind>,
    /// Rows of couplings among them: W of what is written is up to so many more.
    pub coupling_rows: usize,
}

impl Lost {
    /// One more of a kind.
    pub(crate) fn one(&mut self, kind: &str, name: Option<&str>, why: &str) {
        let found = self
            .kinds
            .entry(kind.to_owned())
            .or_insert_with(|| LostKind {
                count: 0,
                example: None,
                why: why.to_owned(),
            });
        found.count += 1;
        if found.example.is_none() {
            found.example = name.map(str::to_owned);
        }
    }

    /// One more that the format written has no word for.
    pub(crate) fn no_word(&mut self, kind: &str, name: Option<&str>) {
        self.one(kind, name, "no word for it there");
    }

    /// One more that is not carried over by this program.
    pub(crate) fn not_read(&mut self, kind: &str, name: Option<&str>) {
        self.one(kind, name, "not carried over");
    }
}

impl Lost {
    /// Adds another table to this one.
    pub(crate) fn add(&mut self, other: Lost) {
        self.coupling_rows += other.coupling_rows;
        for (kind, new) in other.kinds {
            match self.kinds.get_mut(&kind) {
                Some(old) => old.count += new.count,
                None => {
                    self.kinds.insert(kind, new);
                }
            }
        }
    }
}
