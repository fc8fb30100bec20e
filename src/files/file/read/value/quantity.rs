//! Numbers with a meaning: angles, and values that must lie in a range.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::number::number;
use crate::file::schema::Coordinate;
use itertools::Itertools;
use std::f64::consts::PI;

/// Values of one table, each read under its key.
pub(crate) struct ValueTable<'a> {
    /// Path of the table.
    pub(in crate::file::read) at: Vec<DocumentStep>,
    /// Where problems go.
    pub(in crate::file::read) out: &'a mut Findings,
}

/// What a value may be.
#[derive(Clone, Copy)]
pub(crate) enum Bound {
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// From one number to another, both allowed.
    Range(f64, f64, &'static str),
    /// Anything finite.
    Any,
}

impl Bound {
    fn holds(self, x: f64) -> bool {
        match self {
            Bound::Positive => x > 0.0,
            Bound::NotNegative => x >= 0.0,
            Bound::Range(least, most, _) => (least..=most).contains(&x),
            Bound::Any => x.is_finite(),
        }
    }

    fn words(self) -> &'static str {
        match self {
            Bound::Positive => "a number above 0",
            Bound::NotNegative => "0 or a number above it",
            Bound::Range(_, _, words) => words,
            Bound::Any => "a finite number",
        }
    }
}

impl ValueTable<'_> {
    /// A number, times `unit`; 1 where it is none.
    pub(crate) fn number(
        &mut self,
        k: &'static str,
        c: &Coordinate,
        unit: f64,
        bound: Bound,
    ) -> f64 {
        let path = key(&self.at, k);
        self.number_at(&path, k, c, unit, bound)
    }

    /// A number at a path of its own.
    pub(crate) fn number_at(
        &mut self,
        path: &[DocumentStep],
        what: &'static str,
        c: &Coordinate,
        unit: f64,
        bound: Bound,
    ) -> f64 {
        let before = self.out.count();
        let value = number(c, path, self.out).to_f64();
        if self.out.count() > before {
            return 1.0;
        }
        if !bound.holds(value) {
            self.bad(path, what, value.to_string(), bound.words());
            return 1.0;
        }
        value * unit
    }

    /// A number that may be missing.
    pub(crate) fn optional(
        &mut self,
        k: &'static str,
        c: Option<&Coordinate>,
        unit: f64,
        bound: Bound,
    ) -> Option<f64> {
        c.map(|c| self.number(k, c, unit, bound))
    }

    /// A number above 0 that may be missing.
    pub(crate) fn positive(
        &mut self,
        k: &'static str,
        c: &Option<Coordinate>,
        unit: f64,
    ) -> Option<f64> {
        self.optional(k, c.as_ref(), unit, Bound::Positive)
    }

    /// A number from 0 that may be missing.
    pub(crate) fn not_negative(
        &mut self,
        k: &'static str,
        c: &Option<Coordinate>,
        unit: f64,
    ) -> Option<f64> {
        self.optional(k, c.as_ref(), unit, Bound::NotNegative)
    }

    /// Three numbers.
    pub(crate) fn vector(&mut self, k: &'static str, v: &[Coordinate; 3], unit: f64) -> [f64; 3] {
        crate::file::read::value::number::vector(v, &key(&self.at, k), self.out)
            .map(|e| e.to_f64() * unit)
    }

    /// An angle in radians: a number of degrees, or "120deg", "2.1rad", "pi/3", "2*pi/3".
    pub(crate) fn angle(&mut self, k: &'static str, c: &Coordinate) -> f64 {
        let path = key(&self.at, k);
        self.angle_at(&path, k, c)
    }

    /// An angle at a path of its own.
    pub(crate) fn angle_at(
        &mut self,
        path: &[DocumentStep],
        k: &'static str,
        c: &Coordinate,
    ) -> f64 {
        let (inner, unit) = match c {
            Coordinate::Expression(text) => match angle_text(text) {
                Some(found) => found,
                None => {
                    self.bad(
                        path,
                        k,
                        format!("{text:?}"),
                        "degrees, or an angle such as \"120deg\", \"2.1rad\" or \"2*pi/3\"",
                    );
                    return 1.0;
                }
            },
            other => (other.clone(), 1f64.to_radians()),
        };
        self.number_at(path, k, &inner, unit, Bound::Any)
    }

    /// An angle in radians that must lie in a range of degrees.
    pub(crate) fn angle_in(
        &mut self,
        k: &'static str,
        c: &Coordinate,
        least: f64,
        most: f64,
        allowed: &'static str,
    ) -> f64 {
        let found = self.angle(k, c);
        if (least..=most).contains(&found.to_degrees()) {
            return found;
        }
        let path = key(&self.at, k);
        self.bad(&path, k, format!("{} degrees", found.to_degrees()), allowed);
        1.0
    }

    /// Notes a value that will not do.
    pub(crate) fn bad(
        &mut self,
        path: &[DocumentStep],
        what: &'static str,
        value: String,
        allowed: &'static str,
    ) {
        self.out.add(
            path,
            ProblemKind::BadQuantity {
                what,
                value,
                allowed,
            },
        );
    }

    /// Notes a key that goes with another.
    pub(crate) fn needs(&mut self, k: &'static str, other: &'static str) {
        let path = key(&self.at, k);
        self.out.add(&path, ProblemKind::KeyNeeds { key: k, other });
    }

    /// Notes what a table lacks.
    pub(crate) fn needs_at(
        &mut self,
        path: &[DocumentStep],
        what: &'static str,
        other: &'static str,
    ) {
        self.out
            .add(path, ProblemKind::KeyNeeds { key: what, other });
    }

    /// Notes a key that does not go with another.
    pub(crate) fn excludes(&mut self, k: &'static str, other: &'static str) {
        let path = key(&self.at, k);
        self.out
            .add(&path, ProblemKind::KeyExcludes { key: k, other });
    }
}

/// The expression in an angle and the radians in one of it.
fn angle_text(text: &str) -> Option<(Coordinate, f64)> {
    let text = text.trim();
    let expression = |t: &str| Coordinate::Expression(t.trim().to_owned());
    if let Some(t) = text.strip_suffix("deg") {
        return Some((expression(t), 1f64.to_radians()));
    }
    if let Some(t) = text.strip_suffix("rad") {
        return Some((expression(t), 1.0));
    }
    let in_word = |c: Option<char>| c.is_some_and(|c| c.is_ascii_alphanumeric() || c == '_');
    // Not the beginning of another word, such as the name of a parameter.
    let pi = text
        .match_indices("pi")
        .map(|(at, _)| (&text[..at], &text[at + 2..]));
    let alone = |(before, after): &(&str, &str)| {
        !in_word(before.chars().next_back()) && !in_word(after.chars().next())
    };
    let Some((before, after)) = pi.into_iter().find(alone) else {
        return Some((expression(text), 1f64.to_radians()));
    };
    let factor = match before.trim() {
        "" => "1",
        "-" => "-1",
        other => other.strip_suffix('*')?,
    };
    let divided = match after.trim() {
        "" => factor.to_owned(),
        rest => format!("({factor})/({})", rest.strip_prefix('/')?),
    };
    Some((Coordinate::Expression(divided), PI))
}

/// What a word stands for; the first of those known where none is given.
pub(crate) fn word<T: Copy>(
    t: &mut ValueTable<'_>,
    k: &'static str,
    given: Option<&String>,
    known: &[(&'static str, T)],
) -> T {
    let found = given.map_or(Some(known[0].1), |w| {
        known.iter().find(|(n, _)| n == w).map(|(_, v)| *v)
    });
    found.unwrap_or_else(|| {
        let path = key(&t.at, k);
        let words = known.iter().map(|(n, _)| *n).join(", ");
        let word = given.cloned().unwrap_or_default();
        t.out.add(
            &path,
            ProblemKind::UnknownWord {
                what: k,
                word,
                known: words,
            },
        );
        known[0].1
    })
}
