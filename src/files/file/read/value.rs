//! Names, numbers and quantities, with the allowed values of each. Also the maximum size of a file, its unit of length, and `[parameter]`:
//! numbers that expressions know by their names.

pub(crate) mod quantity;

use crate::file::prelude::*;
use crate::file::read::value::quantity::Given;
use crate::geom::expr::{ExprError, WORDS, WrittenNumber};
use crate::model::mechanism::LengthUnit;
use num_bigint::BigInt;
use num_rational::BigRational;

/// Maximum number of links, of joints (and of contours), and of options of one joint in a file.
pub(crate) const LIMITS: (usize, usize, usize) = (2000, 4000, 64);

/// Maximum number of entries of the closure matrix: 256 MB, and an elimination of some minutes.
pub(crate) const ENTRIES: usize = 1 << 25;

const UNITS: [(&str, f64); 5] = [
    ("m", 1.0),
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("um", 1e-6),
    ("in", 0.0254),
];

/// Returns the file's unit of length.
pub(crate) fn length_unit(file: &MechanismFile, out: &Findings) -> LengthUnit {
    let symbol = file.length_unit.as_deref().unwrap_or("m");
    let found = UNITS.into_iter().find(|u| u.0 == symbol);
    let (symbol, metres) = found.unwrap_or_else(|| {
        let known = UNITS.iter().map(|u| u.0);
        out.key("length_unit")
            .add_unknown_word("length unit", symbol, known);
        UNITS[0]
    });
    LengthUnit { symbol, metres }
}

/// Maximum number of parameters.
const MOST: usize = 64;

/// Returns the parameters of a file by name.
fn read_parameters(file: &MechanismFile, out: &Findings) -> BTreeMap<String, Expr> {
    let at = out.key("parameter");
    if !at.count_within(MOST, file.parameter.len(), "parameters") {
        return BTreeMap::new();
    }
    let mut all = BTreeMap::new();
    for (name, value) in &file.parameter {
        let at = at.key(name);
        let first = name.starts_with(|c: char| c.is_ascii_alphabetic());
        let rest = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !first || !rest || WORDS.contains(&name.as_str()) {
            at.add_problem(format!(
                "a parameter cannot be named {name:?}; use a letter followed by letters, digits or _, but not pi, deg, sqrt, cos, sin, tan or cot"
            ));
        }
        all.insert(name.clone(), at.read_coordinate(value));
    }
    all
}

/// Returns findings that know the parameters of a file.
pub(crate) fn with_parameters(file: &MechanismFile) -> Findings {
    let mut out = Findings::default();
    let all = read_parameters(file, &out);
    out.set_parameters(all);
    out
}

/// Maximum number of names listed if a name is unknown.
const LISTED: usize = 30;

impl Words {
    /// Returns the words as a list.
    pub(crate) fn word_list(&self) -> &[String] {
        match self {
            Words::One(word) => std::slice::from_ref(word),
            Words::Many(words) => words,
        }
    }
}

impl Place<'_> {
    /// Reports faults in the name of an item. `twice` is true if another item has the same name.
    pub(crate) fn check_id(&self, what: &str, id: &str, twice: bool) {
        let at = self.key("id");
        if id.is_empty() || id.chars().count() > 64 || id.chars().any(char::is_control) {
            at.add_problem(format!(
                "an id must have 1 to 64 characters and no control characters, not {id:?}"
            ));
        }
        if twice {
            at.add_problem(used_twice(what, id));
        }
    }

    /// Returns the link with the given name; reports an unknown name.
    pub(crate) fn read_link(&self, links: &[Link], id: &str) -> Option<LinkId> {
        let found = links.iter().position(|l| l.id == *id).map(LinkId::new);
        if found.is_none() {
            let known = links.iter().take(LISTED).map(|l| l.id.as_str()).join(", ");
            self.add_problem(format!("unknown link \"{id}\"; known links: {known}"));
        }
        found
    }

    /// Returns the joint with the given name; reports an unknown name.
    pub(crate) fn find_joint(&self, mechanism: &Parts, id: &str) -> Option<JointId> {
        let found = mechanism.joint_named(id);
        if found.is_none() {
            self.unknown_joint(mechanism, id);
        }
        found
    }

    /// Reports an unknown joint.
    pub(crate) fn unknown_joint(&self, mechanism: &Parts, id: &str) {
        let mut ids = mechanism.joints.iter().map(|j| j.id.as_str()).take(LISTED);
        let known = ids.join(", ");
        self.add_problem(format!("unknown joint \"{id}\"; known joints: {known}"));
    }

    /// Returns the states that an entry names; `None` if it names none, which means all.
    pub(crate) fn find_states(&self, named: Option<&Words>) -> Option<Vec<StateId>> {
        let known = &self.out.states;
        let mut found = Vec::new();
        for word in named?.word_list() {
            match known.iter().position(|s| s == word) {
                Some(state) => found.push(StateId::new(state)),
                None => self.add_unknown_word("state", word, known.iter().take(LISTED)),
            }
        }
        Some(found)
    }
}

/// Returns the message of an id that two things have.
pub(crate) fn used_twice(what: &str, id: &str) -> String {
    format!("{what} id \"{id}\" is used twice; ids must be unique")
}

/// Smallest nonzero and largest size of a coordinate.
const RANGE: (f64, f64) = (1e-40, 1e12);
/// A component of a direction that is a smaller part of the largest one is probably a rounded 0.
const NOTHING: f64 = 1e-40;

impl Place<'_> {
    /// Returns a number in the range of lengths.
    pub(crate) fn read_coordinate(&self, c: &Coordinate) -> Expr {
        self.in_range(self.read_number(c, false))
    }

    /// Returns a number in the range of lengths that may contain pi.
    pub(crate) fn read_irrational(&self, c: &Coordinate) -> Expr {
        self.in_range(self.read_number(c, true))
    }

    /// Returns three numbers in the range of lengths.
    pub(crate) fn read_vector(&self, v: &[Coordinate; 3]) -> [Expr; 3] {
        [0, 1, 2].map(|i| self.entry_at(i).read_coordinate(&v[i]))
    }

    /// Returns a direction of any length. It is scaled by a power of ten if its numbers are outside the range of lengths.
    pub(crate) fn read_direction(&self, v: &[Coordinate; 3]) -> [Expr; 3] {
        let read = [0, 1, 2].map(|i| self.entry_at(i).read_number(&v[i], false));
        let largest = read.iter().map(|e| e.to_f64().abs()).fold(0.0, f64::max);
        if read.iter().all(|e| is_usual(e.to_f64().abs())) {
            return read;
        }
        let kept = read.map(|e| {
            let nothing = e.written() != WrittenNumber::No && e.to_f64().abs() < NOTHING * largest;
            if nothing { Expr::from(0) } else { e }
        });
        if largest == 0.0 || is_usual(largest) {
            return kept;
        }
        #[allow(clippy::cast_possible_truncation, reason = "at most 324 in size")]
        let power = largest.log10().floor() as i32;
        let ten = BigRational::from_integer(BigInt::from(10));
        let factor = Expr::rational(num_traits::Pow::pow(&ten, -power));
        kept.map(|e| e.scaled_as_written(&e * &factor, 10f64.powi(-power)))
    }

    /// Returns the pitch of a screw per radian, from the pitch or from the lead, which is per turn; `None` if neither is given.
    pub(crate) fn read_pitch(&self, pitch: &Given, lead: &Given) -> Option<Expr> {
        if pitch.is_some() && lead.is_some() {
            self.add_excluded_key("lead", "pitch");
        }
        if let Some(c) = pitch {
            return Some(self.key("pitch").read_irrational(c));
        }
        let lead = self.key("lead").read_coordinate(lead.as_ref()?);
        let turn = Expr::from(2) * Expr::pi();
        if lead.is_zero_rational() {
            return Some(lead);
        }
        let pitch = lead.div(&turn)?;
        Some(lead.scaled_as_written(pitch, 1.0 / std::f64::consts::TAU))
    }

    /// Returns what is read from the value of a key, if it is given.
    pub(crate) fn read_given<T, R>(
        &self,
        key: &str,
        value: Option<&T>,
        read: impl FnOnce(&Self, &T) -> R,
    ) -> Option<R> {
        value.map(|v| read(&self.key(key), v))
    }

    fn in_range(&self, e: Expr) -> Expr {
        let size = e.to_f64().abs();
        // An irrational expression may cancel to zero, and is then zero; a number too small for doubles is not.
        let lost = size == 0.0 && e.as_rational().is_some() && !e.is_zero_rational();
        if is_usual(size) && !lost {
            return e;
        }
        self.add_problem(format!(
            "coordinate {} is out of range; lengths may be 1e-40 to 1e12 in size; choose another length_unit",
            shorten(&e)
        ));
        Expr::from(0)
    }

    fn read_number(&self, c: &Coordinate, pi_is_a_number: bool) -> Expr {
        let parsed = match c {
            Coordinate::Integer(i) => Ok(Expr::from(*i).written_as(WrittenNumber::Whole)),
            Coordinate::Decimal(x) => Expr::from_f64(*x),
            Coordinate::Expression(s) => self.out.parse_expression(s, pi_is_a_number),
        };
        parsed.unwrap_or_else(|e| {
            let known = self.out.parameter_names().join(", ");
            let parameters = match e {
                ExprError::UnknownWord { .. } if !known.is_empty() => {
                    format!(", and the parameters {known}")
                }
                _ => String::new(),
            };
            self.add_problem(format!("{e}{parameters}"));
            Expr::from(0)
        })
    }
}

/// Returns true if a coordinate is 0 or of a size that can be calculated with.
fn is_usual(size: f64) -> bool {
    size == 0.0 || (RANGE.0..=RANGE.1).contains(&size)
}

/// Formats a number as written, or shortened if it does not fit into a line.
fn shorten(e: &Expr) -> String {
    let text = e.to_string();
    match text.len() {
        ..=40 => text,
        _ => format!("{:e}", e.to_f64()),
    }
}
