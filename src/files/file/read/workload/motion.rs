//! Positions and speeds of drives, with the units that files may write.

use crate::file::Place;
use crate::file::schema::Quantity;
use crate::model::loads::Stroke;
use thiserror::Error;

/// Maximum number of forces, moments or misalignments.
pub(in crate::file::read) const MAX_FORCES: usize = 10_000;
/// Maximum number of steps of a stroke.
pub(crate) const MAX_STEPS: usize = 100_000;
/// Largest mass, inertia or speed.
pub(in crate::file::read) const LARGEST: f64 = 1e12;

/// Parses a drive position in radians or the file's length unit: "1.5", "1.5rad", "360deg".
fn parse_position(text: &str) -> Option<f64> {
    with_units(text, &[("deg", 1f64.to_radians()), ("rad", 1.0)])
}

/// Parses a drive speed in rad/s or the file's length unit per second: "6.28", "60rpm", "30deg/s".
fn parse_speed(text: &str) -> Option<f64> {
    let rpm = std::f64::consts::TAU / 60.0;
    let units = [("rpm", rpm), ("deg/s", 1f64.to_radians()), ("rad/s", 1.0)];
    with_units(text, &units)
}

/// A text that is not a valid stroke.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("stroke {0:?} is not FROM:TO:STEPS, such as 0:360deg:72 with 1 to {MAX_STEPS} steps")]
pub struct NoStroke(String);

/// Parses a range and its steps, such as "0:360deg:72".
///
/// # Errors
/// Returns an error if the text is not a stroke.
///
/// # Examples
/// ```
/// use ozols::file::read::workload::motion::parse_stroke;
/// let turn = parse_stroke("0:360deg:72")?;
/// assert_eq!((turn.to, turn.steps), (std::f64::consts::TAU, 72));
/// assert!(parse_stroke("0:360deg").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn parse_stroke(text: &str) -> Result<Stroke, NoStroke> {
    let parse = || {
        let (from, rest) = text.split_once(':')?;
        let (to, steps) = rest.split_once(':')?;
        let (from, to) = (parse_position(from)?, parse_position(to)?);
        let steps = steps.parse().ok().filter(|n| (1..=MAX_STEPS).contains(n))?;
        Some(Stroke { from, to, steps })
    };
    parse().ok_or_else(|| NoStroke(text.to_owned()))
}

fn with_units(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let text = text.trim();
    let mut units = units.iter();
    let found = units.find_map(|(u, f)| Some((text.strip_suffix(u)?.trim_end(), *f)));
    let (number, factor) = found.unwrap_or((text, 1.0));
    let value = number.parse::<f64>().ok()? * factor;
    (value.abs() <= LARGEST).then_some(value)
}

impl Place<'_> {
    /// Returns a number with a unit; 0 if it is not valid, which is reported.
    fn read_quantity(
        &self,
        q: &Quantity,
        parse: fn(&str) -> Option<f64>,
        what: &str,
        allowed: &str,
    ) -> f64 {
        let (value, shown) = match q {
            Quantity::Number(x) => (Some(*x).filter(|x| x.abs() <= LARGEST), x.to_string()),
            Quantity::Text(t) => (parse(t), format!("{t:?}")),
        };
        if value.is_none() {
            self.add_bad_value(what, shown, allowed);
        }
        value.unwrap_or(0.0)
    }

    /// Returns a position of a drive.
    pub(crate) fn read_position(&self, q: &Quantity) -> f64 {
        let allowed =
            "a number of radians or length units such as 1.5, or an angle such as \"90deg\"";
        self.read_quantity(q, parse_position, "drive position", allowed)
    }

    /// Returns a speed of a drive.
    pub(crate) fn read_speed(&self, q: &Quantity) -> f64 {
        let allowed = "a number of rad/s or length units per second, or a speed such as \"60rpm\" or \"30deg/s\"";
        self.read_quantity(q, parse_speed, "drive speed", allowed)
    }

    /// Returns a small angle.
    pub(crate) fn read_turn(&self, q: &Quantity) -> f64 {
        let allowed = "a number of radians, or an angle such as \"0.1deg\"";
        self.read_quantity(q, parse_position, "angle", allowed)
    }
}
