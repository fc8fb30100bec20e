//! Numbers from their entries: lengths, directions, pitches.

use crate::file::Place;
use crate::file::schema::Coordinate;
use crate::geom::expr::{Expr, ExprError, WrittenNumber};
use itertools::Itertools;
use num_bigint::BigInt;
use num_rational::BigRational;

/// Smallest nonzero and largest size of a coordinate.
const RANGE: (f64, f64) = (1e-40, 1e12);
/// A component of a direction that is a smaller part of the largest one is what a program makes of 0.
const NOTHING: f64 = 1e-40;

impl Place<'_> {
    /// Returns a number in the range of lengths.
    pub(crate) fn number(&self, c: &Coordinate) -> Expr {
        self.in_range(self.read_number(c, false))
    }

    /// Returns three numbers in the range of lengths.
    pub(crate) fn vector(&self, v: &[Coordinate; 3]) -> [Expr; 3] {
        [0, 1, 2].map(|i| self.index(i).number(&v[i]))
    }

    /// Returns a direction of any length. It is scaled by a power of ten if its numbers are outside the range of lengths.
    pub(crate) fn direction(&self, v: &[Coordinate; 3]) -> [Expr; 3] {
        let read = [0, 1, 2].map(|i| self.index(i).read_number(&v[i], false));
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
    pub(crate) fn pitch(
        &self,
        pitch: &Option<Coordinate>,
        lead: &Option<Coordinate>,
    ) -> Option<Expr> {
        if pitch.is_some() && lead.is_some() {
            self.excludes("lead", "pitch");
        }
        if let Some(c) = pitch {
            let at = self.key("pitch");
            return Some(at.in_range(at.read_number(c, true)));
        }
        let lead = self.key("lead").number(lead.as_ref()?);
        let turn = Expr::from(2) * Expr::pi();
        if lead.is_zero_rational() {
            return Some(lead);
        }
        let pitch = lead.div(&turn)?;
        Some(lead.scaled_as_written(pitch, 1.0 / std::f64::consts::TAU))
    }

    fn in_range(&self, e: Expr) -> Expr {
        let size = e.to_f64().abs();
        // An irrational expression may cancel to zero, and is then zero; a number that is too small for doubles is not.
        let lost = size == 0.0 && e.as_rational().is_some() && !e.is_zero_rational();
        if is_usual(size) && !lost {
            return e;
        }
        self.add(format!(
            "coordinate {} is out of range; lengths may be 1e-40 to 1e12 in size; choose another length_unit",
            short(&e)
        ));
        Expr::from(0)
    }

    fn read_number(&self, c: &Coordinate, pi_is_a_number: bool) -> Expr {
        let parsed = match c {
            Coordinate::Integer(i) => Ok(Expr::from(*i).written_as(WrittenNumber::Whole)),
            Coordinate::Decimal(x) => Expr::from_f64(*x),
            Coordinate::Expression(s) => self.out.expression(s, pi_is_a_number),
        };
        parsed.unwrap_or_else(|e| {
            let known = self.out.names().join(", ");
            let parameters = match e {
                ExprError::UnknownWord { .. } if !known.is_empty() => {
                    format!(", and the parameters {known}")
                }
                _ => String::new(),
            };
            self.add(format!("{e}{parameters}"));
            Expr::from(0)
        })
    }
}

/// Returns true if a coordinate is 0 or of a size that can be calculated with.
fn is_usual(size: f64) -> bool {
    size == 0.0 || (RANGE.0..=RANGE.1).contains(&size)
}

/// Formats a number as written, or shortened if it does not fit into a line.
fn short(e: &Expr) -> String {
    let text = e.to_string();
    match text.len() {
        ..=40 => text,
        _ => format!("{:e}", e.to_f64()),
    }
}
