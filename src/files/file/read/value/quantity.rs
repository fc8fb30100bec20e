//! Numbers with a meaning: angles, and values that must lie in a range.

use crate::file::prelude::*;
use crate::geom::expr::{End, WrittenNumber};
use std::fmt::Display;

/// A number that a file may give.
pub(crate) type Given = Option<Coordinate>;

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
    fn is_met(self, x: f64) -> bool {
        match self {
            Bound::Positive => x > 0.0,
            Bound::NotNegative => x >= 0.0,
            Bound::Range(least, most, _) => (least..=most).contains(&x),
            Bound::Any => x.is_finite(),
        }
    }

    fn allowed_words(self) -> &'static str {
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
    pub(crate) fn read_value(&self, what: &str, c: &Coordinate, unit: f64, bound: Bound) -> f64 {
        let before = self.out.problem_count();
        let value = self.read_coordinate(c).to_f64();
        if self.out.problem_count() > before {
            return 1.0;
        }
        if !bound.is_met(value) {
            self.add_bad_value(what, value, bound.allowed_words());
            return 1.0;
        }
        value * unit
    }

    /// Returns the number of a key of the table at this place, times `unit`.
    pub(crate) fn read_figure(&self, k: &str, c: &Coordinate, unit: f64, bound: Bound) -> f64 {
        self.key(k).read_value(k, c, unit, bound)
    }

    /// Returns a number that may be missing.
    pub(crate) fn read_optional(&self, k: &str, c: &Given, unit: f64, bound: Bound) -> Option<f64> {
        c.as_ref().map(|c| self.read_figure(k, c, unit, bound))
    }

    /// Returns a number above 0 that may be missing.
    pub(crate) fn read_positive(&self, k: &str, c: &Given, unit: f64) -> Option<f64> {
        self.read_optional(k, c, unit, Bound::Positive)
    }

    /// Returns a number of 0 or more that may be missing.
    pub(crate) fn not_negative(&self, k: &str, c: &Given, unit: f64) -> Option<f64> {
        self.read_optional(k, c, unit, Bound::NotNegative)
    }

    /// Returns a number of items from 1 to `most`; reports any other.
    pub(crate) fn number_of(
        &self,
        what: &str,
        count: impl Copy + Display + TryInto<usize>,
        most: usize,
        allowed: &str,
    ) -> Option<usize> {
        let found = count.try_into().ok().filter(|n| (1..=most).contains(n));
        if found.is_none() {
            self.add_bad_value(what, count, allowed);
        }
        found
    }

    /// Returns three numbers times `unit`.
    pub(crate) fn read_reals(&self, v: &[Coordinate; 3], unit: f64) -> [f64; 3] {
        self.read_vector(v).map(|e| e.to_f64() * unit)
    }

    /// Returns an angle in radians: a number of degrees, or "120deg", "2.1rad", "pi/3", "2*pi/3".
    pub(crate) fn read_angle(&self, what: &str, c: &Coordinate) -> f64 {
        let degree = 1f64.to_radians();
        let Coordinate::Expression(text) = c else {
            return self.read_value(what, c, degree, Bound::Any);
        };
        let text = text.trim();
        let in_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let (text, unit) = match (text.strip_suffix("deg"), text.strip_suffix("rad")) {
            (Some(degrees), _) => (degrees, degree),
            (_, Some(radians)) => (radians, 1.0),
            // Not the beginning of another word, such as the name of a parameter.
            _ if text.split(|c| !in_word(c)).any(|word| word == "pi") => (text, 1.0),
            _ => (text, degree),
        };
        let before = self.out.problem_count();
        let inner = Coordinate::Expression(text.trim().to_owned());
        let value = self.read_irrational(&inner).to_f64();
        if self.out.problem_count() > before {
            return 1.0;
        }
        value * unit
    }

    /// Returns an angle in radians that must be in a range of degrees.
    pub(crate) fn angle_in(&self, k: &str, c: &Coordinate, range: [f64; 2], allowed: &str) -> f64 {
        let found = self.key(k).read_angle(k, c);
        if (range[0]..=range[1]).contains(&found.to_degrees()) {
            return found;
        }
        self.key(k).bad_angle(k, found, allowed);
        1.0
    }

    /// Reports an angle that is not allowed.
    pub(crate) fn bad_angle(&self, what: &str, angle: f64, allowed: &str) {
        let degrees = format!("{} degrees", angle.to_degrees());
        self.add_bad_value(what, degrees, allowed);
    }

    /// Returns the meaning of a word. If no word is given, it is that of the first known one.
    pub(crate) fn read_word<T: Copy>(
        &self,
        k: &str,
        given: &Option<String>,
        known: &[(&'static str, T)],
    ) -> T {
        let Some(word) = given else { return known[0].1 };
        let found = known.iter().find(|(n, _)| n == word);
        if found.is_none() {
            self.key(k)
                .add_unknown_word(k, word, known.iter().map(|(n, _)| n));
        }
        found.unwrap_or(&known[0]).1
    }
}

/// Maximum uncertainty of a direction, in radians.
const MOST_TURN: f64 = 0.1;
/// Maximum uncertainty of places, as a fraction of the size of the mechanism.
const MOST_SHIFT: f64 = 0.1;

/// Replaces the uncertainties that follow from the digits by the stated ones.
pub(crate) fn read_tolerance(file: &MechanismFile, m: &mut Parts, out: &Findings) {
    let across = m.distance_across();
    // Joints that are all in one place have no size.
    let tenth = MOST_SHIFT * across;
    let most = if across > 0.0 { tenth } else { f64::INFINITY };
    let allowed = "0, or at most a tenth of the distance across the joints";
    let shift = |at: Place<'_>, c: &Given| at.read_stated(c, most, allowed);
    let of_file = file.tolerance.clone().unwrap_or_default();
    let at = out.key("tolerance");
    let lengths = shift(at.key("length"), &of_file.length);
    let of_joints = out.key("joint").each_entry(&file.joint);
    let of_joints = of_joints.map(|(at, j)| shift(at.key("tolerance"), &j.tolerance));
    let of_joints: Vec<Option<f64>> = of_joints.collect();
    let of_points = out.key("point").each_entry(&file.point);
    let of_points = of_points.map(|(at, p)| shift(at.key("tolerance"), &p.tolerance));
    let of_points: Vec<Option<f64>> = of_points.collect();
    let at = at.key("direction");
    let directions = at.read_stated(&of_file.direction, MOST_TURN, "0, or at most 0.1 rad");
    for (joint, own) in m.joints.iter_mut().zip(of_joints) {
        joint_at(joint, lengths, directions, own);
    }
    for (point, own) in m.points.iter_mut().zip(of_points) {
        set_point_half(&mut point.point, lengths, own);
    }
}

impl Place<'_> {
    /// Returns a tolerance; `None` if it is missing or not valid.
    fn read_stated(&self, c: &Given, most: f64, allowed: &str) -> Option<f64> {
        let before = self.out.problem_count();
        let value = self.read_coordinate(c.as_ref()?).to_f64();
        if self.out.problem_count() > before {
            return None;
        }
        let fits = (0.0..=most).contains(&value);
        if !fits {
            self.add_bad_value("tolerance", value, allowed);
        }
        fits.then_some(value)
    }
}

fn joint_at(joint: &mut Joint, lengths: Option<f64>, directions: Option<f64>, own: Option<f64>) {
    let before = joint.frame.point.clone();
    let at_joint = |f: &Frame| f.point.iter().zip(&before).all(|(a, b)| a.is_same(b));
    let offered = joint.options.iter_mut().chain(&mut joint.unloading);
    let frames = offered.map(|o| &mut o.frame).chain([&mut joint.frame]);
    for frame in frames {
        let own = own.filter(|_| at_joint(frame));
        set_point_half(&mut frame.point, lengths, own);
        if let Some(half) = lengths {
            set_pitch_half(&mut frame.pitch, half);
        }
        if let Some(half) = directions {
            set_direction_half(&mut frame.axis, half);
            set_direction_half(&mut frame.reference, half);
        }
    }
}

/// Sets the uncertainty of a point: of all its numbers if it has its own tolerance, otherwise of those written as numbers, except
/// whole 0.
fn set_point_half(point: &mut [Expr; 3], of_file: Option<f64>, own: Option<f64>) {
    for e in point {
        let half =
            own.or_else(|| of_file.filter(|_| is_number(e) && !(is_whole(e) && e.to_f64() == 0.0)));
        set_half(e, half);
    }
}

/// Sets the uncertainty of a direction in radians: of its numbers, except whole 0 and 1.
fn set_direction_half(v: &mut [Expr; 3], half: f64) {
    let of_length = half * length(to_vector(v));
    for e in v {
        let size = e.to_f64().abs();
        let chosen = is_whole(e) && (size == 0.0 || size == 1.0);
        set_half(e, Some(of_length).filter(|_| is_number(e) && !chosen));
    }
}

/// Sets the uncertainty of a pitch, or of the pitch that follows from a lead.
fn set_pitch_half(e: &mut Expr, half: f64) {
    let WrittenNumber::Decimal(digits) = e.written() else {
        return;
    };
    set_half(e, Some(half * digits.factor()));
}

fn set_half(e: &mut Expr, half: Option<f64>) {
    if let Some(half) = half {
        *e = std::mem::replace(e, Expr::from(0)).with_half_unit(half);
    }
}

fn is_number(e: &Expr) -> bool {
    use WrittenNumber::{Decimal, Whole};
    matches!(e.written(), Decimal(_) | Whole)
}

fn is_whole(e: &Expr) -> bool {
    match e.written() {
        WrittenNumber::Whole => true,
        WrittenNumber::Decimal(digits) => digits.end == End::Float,
        WrittenNumber::No | WrittenNumber::Stated(_) => false,
    }
}
