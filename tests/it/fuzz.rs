//! No input makes the program panic: files and expressions, spoilt in many ways; and what is read means what it says.
//!
//! The usual run takes some hundred inputs a target. A long one takes as many as it is told:
//!
//! ```text
//! OZOLS_FUZZ=100000 cargo test --test integration fuzz
//! ```
//!
//! What fails is made small, shown, and kept in `tests/proptest-regressions`, whence every later run tries it first. The
//! search against brute force on small random mechanisms is in `twin`, and takes the same number. `tests/fuzz/run` makes inputs
//! by how far into the code earlier ones came; `corpus` reads what was kept of them.

use crate::common::*;
mod corpus;
mod expressions;
mod mechanism_files;
pub(crate) mod readers;

use std::ops::Range;

/// So many inputs as the variable `OZOLS_FUZZ` says; few where it says nothing.
pub(crate) fn runs(few: u32) -> ProptestConfig {
    let cases = std::env::var("OZOLS_FUZZ").map_or(few, |n| n.parse().unwrap());
    default_with(|p: &mut ProptestConfig| (p.cases, p.max_shrink_iters) = (cases, 200))
}

/// What a piece of a text is.
#[derive(Debug, Clone, Copy)]
enum Unit {
    Byte,
    /// Digits with their sign, point and exponent.
    Number,
    /// From one quote to the next: a value, or what stands between two.
    Quoted,
    Line,
    /// From one `<` to the next.
    Tag,
}

const UNITS: [Unit; 5] = [
    Unit::Byte,
    Unit::Number,
    Unit::Quoted,
    Unit::Line,
    Unit::Tag,
];

impl Unit {
    /// Where the pieces of a text are.
    fn pieces(self, text: &[u8]) -> Vec<Range<usize>> {
        let between = |ends: Vec<usize>| ends.windows(2).map(|w| w[0]..w[1]).collect();
        let each = |wanted: u8| (0..text.len()).filter(move |&i| text[i] == wanted);
        match self {
            Unit::Byte => (0..text.len()).map(|i| i..i + 1).collect(),
            Unit::Number => {
                let of = |i: usize| text[i].is_ascii_digit() || b"+-.e".contains(&text[i]);
                let starts = (0..text.len()).filter(|&i| of(i) && (i == 0 || !of(i - 1)));
                starts
                    .map(|i| i..(i..text.len()).find(|&j| !of(j)).unwrap_or(text.len()))
                    .filter(|r| text[r.clone()].iter().any(u8::is_ascii_digit))
                    .collect()
            }
            Unit::Quoted => {
                let quotes: Vec<usize> = each(b'"').collect();
                quotes.windows(2).map(|w| w[0] + 1..w[1]).collect()
            }
            Unit::Line => between(
                std::iter::once(0)
                    .chain(each(b'\n').map(|i| i + 1))
                    .collect(),
            ),
            Unit::Tag => between(each(b'<').chain([text.len()]).collect()),
        }
    }
}

/// What comes in place of some pieces.
#[derive(Debug, Clone)]
enum Put {
    Text(String),
    /// As many pieces from elsewhere in the text: out of order, doubled, or within others.
    Copy(Index),
}

/// One change of a text.
#[derive(Debug, Clone)]
struct Edit {
    unit: Unit,
    at: Index,
    /// How many pieces are replaced; none to insert.
    taken: usize,
    /// How many pieces are copied.
    copied: usize,
    put: Put,
}

impl Edit {
    fn apply(&self, text: &mut Vec<u8>) {
        let pieces = self.unit.pieces(text);
        if pieces.is_empty() {
            return;
        }
        let several = |from: usize, count: usize| {
            let last = (from + count).min(pieces.len());
            let end = if count == 0 { from } else { last };
            let end = pieces
                .get(end)
                .map_or(pieces[pieces.len() - 1].end, |p| p.start);
            pieces[from].start..if count == 1 { pieces[from].end } else { end }
        };
        let put = match &self.put {
            Put::Text(t) => t.clone().into_bytes(),
            Put::Copy(from) => text[several(from.index(pieces.len()), self.copied)].to_vec(),
        };
        text.splice(several(self.at.index(pieces.len()), self.taken), put);
    }
}

/// A few changes; `words` are what the reader of such a text may stumble over.
fn edits(words: &'static [&'static str]) -> impl Strategy<Value = Vec<Edit>> {
    let put = prop_oneof![
        3 => select(words).prop_map(|w| Put::Text(w.to_owned())),
        1 => ".{0,8}".prop_map(Put::Text),
        2 => any::<Index>().prop_map(Put::Copy),
    ];
    let edit = (
        select(&UNITS[..]),
        any::<Index>(),
        0usize..6,
        1usize..6,
        put,
    );
    let edit = edit.prop_map(|(unit, at, taken, copied, put)| Edit {
        unit,
        at,
        taken,
        copied,
        put,
    });
    prop::collection::vec(edit, 1..4)
}

/// The text after the changes.
fn spoilt(text: impl AsRef<[u8]>, edits: &[Edit]) -> Vec<u8> {
    let mut bytes = text.as_ref().to_vec();
    for edit in edits {
        edit.apply(&mut bytes);
    }
    bytes
}
