//! Numbers with a meaning: angles, and values that must lie in a range.

use crate::file::Place;
use crate::file::schema::Coordinate;
use std::f64::consts::PI;
use std::fmt::Display;

/// The allowed range of a value.
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

impl Place<'_> {
    /// Returns a number times `unit`; 1 if it is not valid, which is reported.
    pub(crate) fn value(&self, what: &'static str, c: &Coordinate, unit: f64, bound: Bound) -> f64 {
        let before = self.out.count();
        let value = self.number(c).to_f64();
        if self.out.count() > before {
            return 1.0;
        }
        if !bound.holds(value) {
            self.bad(what, value, bound.words());
            return 1.0;
        }
        value * unit
    }

    /// Returns the number of a key of the table at this place, times `unit`.
    pub(crate) fn figure(&self, k: &'static str, c: &Coordinate, unit: f64, bound: Bound) -> f64 {
        self.key(k).value(k, c, unit, bound)
    }

    /// Returns a number that may be missing.
    pub(crate) fn optional(
        &self,
        k: &'static str,
        c: &Option<Coordinate>,
        unit: f64,
        bound: Bound,
    ) -> Option<f64> {
        c.as_ref().map(|c| self.figure(k, c, unit, bound))
    }

    /// Returns a number above 0 that may be missing.
    pub(crate) fn positive(
        &self,
        k: &'static str,
        c: &Option<Coordinate>,
        unit: f64,
    ) -> Option<f64> {
        self.optional(k, c, unit, Bound::Positive)
    }

    /// Returns a number of 0 or more that may be missing.
    pub(crate) fn not_negative(
        &self,
        k: &'static str,
        c: &Option<Coordinate>,
        unit: f64,
    ) -> Option<f64> {
        self.optional(k, c, unit, Bound::NotNegative)
    }

    /// Returns a number of items from 1 to `most`; reports any other.
    pub(crate) fn number_of(
        &self,
        what: &'static str,
        count: impl Copy + Display + TryInto<usize>,
        most: usize,
        allowed: &'static str,
    ) -> Option<usize> {
        let found = count.try_into().ok().filter(|n| (1..=most).contains(n));
        if found.is_none() {
            self.bad(what, count, allowed);
        }
        found
    }

    /// Returns three numbers times `unit`.
    pub(crate) fn reals(&self, v: &[Coordinate; 3], unit: f64) -> [f64; 3] {
        self.vector(v).map(|e| e.to_f64() * unit)
    }

    /// Returns an angle in radians: a number of degrees, or "120deg", "2.1rad", "pi/3", "2*pi/3".
    pub(crate) fn angle(&self, what: &'static str, c: &Coordinate) -> f64 {
        let (inner, unit) = match c {
            Coordinate::Expression(text) => match angle_text(text) {
                Some(found) => found,
                None => {
                    let allowed =
                        "degrees, or an angle such as \"120deg\", \"2.1rad\" or \"2*pi/3\"";
                    self.bad(what, format!("{text:?}"), allowed);
                    return 1.0;
                }
            },
            other => (other.clone(), 1f64.to_radians()),
        };
        self.value(what, &inner, unit, Bound::Any)
    }

    /// Returns an angle in radians that must be in a range of degrees.
    pub(crate) fn angle_in(
        &self,
        k: &'static str,
        c: &Coordinate,
        range: [f64; 2],
        allowed: &'static str,
    ) -> f64 {
        let found = self.key(k).angle(k, c);
        if (range[0]..=range[1]).contains(&found.to_degrees()) {
            return found;
        }
        self.key(k).bad_angle(k, found, allowed);
        1.0
    }

    /// Reports an angle that is not allowed.
    pub(crate) fn bad_angle(&self, what: &'static str, angle: f64, allowed: &'static str) {
        let degrees = format!("{} degrees", angle.to_degrees());
        self.bad(what, degrees, allowed);
    }

    /// Returns the meaning of a word. If no word is given, it is that of the first known one.
    pub(crate) fn word<T: Copy>(
        &self,
        k: &'static str,
        given: &Option<String>,
        known: &[(&'static str, T)],
    ) -> T {
        let Some(word) = given else { return known[0].1 };
        let found = known.iter().find(|(n, _)| n == word);
        if found.is_none() {
            self.key(k).unknown(k, word, known.iter().map(|(n, _)| n));
        }
        found.unwrap_or(&known[0]).1
    }
}

/// Returns the expression of an angle and its radians per unit.
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
