//! A motion of a gripper as CSV: one step a line.

use crate::model::grip::MotionStep;
use csv::StringRecord;
use thiserror::Error;

/// Most steps.
const MOST: usize = 100_000;

/// The columns: the first three are needed, the three of gravity go together.
const COLUMNS: [&str; 8] = ["ax", "ay", "az", "gx", "gy", "gz", "time", "diameter"];

/// The problem with a table of a motion: the file, the line if it is known, and what is wrong.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{0}")]
pub struct TrajectoryError(String);

/// The columns of the figures of a step.
struct StepColumns {
    acceleration: [usize; 3],
    gravity: Option<[usize; 3]>,
    time: Option<usize>,
    diameter: Option<usize>,
}

impl StepColumns {
    /// Returns the columns by the names in the first line, or describes what is wrong with these.
    fn of(names: &StringRecord) -> Result<StepColumns, String> {
        if let Some(unknown) = names.iter().find(|n| !COLUMNS.contains(n)) {
            return Err(format!("unknown column {unknown:?}"));
        }
        let place = COLUMNS.map(|c| names.iter().position(|n| n == c));
        let [ax, ay, az, gx, gy, gz, time, diameter] = place;
        let (Some(ax), Some(ay), Some(az)) = (ax, ay, az) else {
            return Err("ax, ay and az are needed".to_owned());
        };
        let gravity = match (gx, gy, gz) {
            (Some(x), Some(y), Some(z)) => Some([x, y, z]),
            (None, None, None) => None,
            _ => return Err("gx, gy and gz go together".to_owned()),
        };
        Ok(StepColumns {
            acceleration: [ax, ay, az],
            gravity,
            time,
            diameter,
        })
    }
}

/// A line of figures under the names of their columns.
struct Figures<'a> {
    names: &'a StringRecord,
    record: &'a StringRecord,
}

impl Figures<'_> {
    /// Returns the number in a column, at least `least`, or describes what is wrong with it.
    fn number(&self, column: usize, least: f64) -> Result<f64, String> {
        let text = self.record.get(column).unwrap_or("");
        let found = text
            .parse::<f64>()
            .ok()
            .filter(|x| (least..=1e6).contains(x));
        let name = self.names.get(column).unwrap_or("");
        found.ok_or_else(|| format!("{name} is {text:?}; give a number of at most 1e6 in size"))
    }

    /// Returns the step of the line, with diameters in `unit` metres.
    fn step(&self, columns: &StepColumns, unit: f64) -> Result<MotionStep, String> {
        let vector = |[x, y, z]: [usize; 3]| -> Result<[f64; 3], String> {
            Ok([
                self.number(x, -1e6)?,
                self.number(y, -1e6)?,
                self.number(z, -1e6)?,
            ])
        };
        let [ax, ay, az] = columns.acceleration;
        let time = columns.time.map(|c| self.number(c, -1e6)).transpose()?;
        let diameter = columns.diameter.map(|c| self.number(c, 1e-9)).transpose()?;
        Ok(MotionStep {
            time,
            diameter: diameter.map(|d| d * unit),
            gravity: columns.gravity.map(vector).transpose()?,
            acceleration: vector([ax, ay, az])?,
        })
    }
}

/// Reads a motion; accelerations in m/s² in the gripper's axes, diameters in `unit` metres.
///
/// # Errors
/// Returns a [`TrajectoryError`].
pub fn trajectory(file: &str, bytes: &[u8], unit: f64) -> Result<Vec<MotionStep>, TrajectoryError> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(bytes);
    let at = |line: usize, what: String| TrajectoryError(format!("{file}:{line}: {what}"));
    let head = |what: String| {
        at(
            1,
            format!(
                "{what}; columns are ax, ay, az in m/s², and optionally gx, gy, gz in m/s², time in s, diameter"
            ),
        )
    };
    let names = reader.headers().map_err(|e| head(e.to_string()))?.clone();
    let columns = StepColumns::of(&names).map_err(head)?;
    let mut out = Vec::new();
    for (i, record) in reader.records().enumerate() {
        let record = record.map_err(|e| at(i + 2, e.to_string()))?;
        let line = record
            .position()
            .and_then(|p| usize::try_from(p.line()).ok());
        let (names, record) = (&names, &record);
        let step = Figures { names, record }.step(&columns, unit);
        out.push(step.map_err(|what| at(line.unwrap_or(i + 2), what))?);
    }
    match out.len() {
        1..=MOST => Ok(out),
        count => Err(TrajectoryError(format!(
            "{file}: {count} steps; give 1 to {MOST}"
        ))),
    }
}
