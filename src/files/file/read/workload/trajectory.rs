//! A motion of a gripper as CSV: one step a line.

use crate::model::grip::MotionStep;
use csv::StringRecord;
use thiserror::Error;

/// Maximum number of steps.
const MOST: usize = 100_000;

/// The columns. The first three are required; the three of gravity require each other.
const COLUMNS: [&str; 8] = ["ax", "ay", "az", "gx", "gy", "gz", "time", "diameter"];

/// The problem with a table of a motion: the file, the line if it is known, and the fault.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{0}")]
pub struct TrajectoryError(String);

/// Describes the fault in the names of columns.
fn check_names(names: &StringRecord) -> Result<(), String> {
    if let Some(unknown) = names.iter().find(|n| !COLUMNS.contains(n)) {
        return Err(format!("unknown column {unknown:?}"));
    }
    let there = COLUMNS.map(|c| names.iter().any(|n| n == c));
    if !there[..3].iter().all(|t| *t) {
        return Err("ax, ay and az are needed".to_owned());
    }
    if !there[3..6].iter().all(|t| *t == there[3]) {
        return Err("gx, gy and gz go together".to_owned());
    }
    Ok(())
}

/// Returns the step in a line, or describes its fault.
fn read_step(names: &StringRecord, record: &StringRecord, unit: f64) -> Result<MotionStep, String> {
    let number = |column: &str, least: f64| {
        let Some(at) = names.iter().position(|n| n == column) else {
            return Ok(None);
        };
        let text = record.get(at).unwrap_or("");
        match text.parse::<f64>() {
            Ok(x) if (least..=1e6).contains(&x) => Ok(Some(x)),
            _ => Err(format!(
                "{column} is {text:?}; give a number of at most 1e6 in size"
            )),
        }
    };
    let vector = |columns: [&str; 3]| -> Result<Option<[f64; 3]>, String> {
        let [x, y, z] = columns.map(|c| number(c, -1e6));
        let (x, y, z) = (x?, y?, z?);
        Ok(x.zip(y).zip(z).map(|((x, y), z)| [x, y, z]))
    };
    Ok(MotionStep {
        time: number("time", -1e6)?,
        diameter: number("diameter", 1e-9)?.map(|d| d * unit),
        gravity: vector(["gx", "gy", "gz"])?,
        acceleration: vector(["ax", "ay", "az"])?.unwrap_or_default(),
    })
}

/// Reads a motion; accelerations in m/s² in the gripper's axes, diameters in `unit` metres.
///
/// # Errors
/// Returns a [`TrajectoryError`].
///
/// # Examples
/// ```
/// use ozols::file::read::workload::trajectory::read_trajectory;
/// let steps = read_trajectory("motion.csv", b"time,ax,ay,az\n0,0,0,0\n0.1,5,0,0\n", 0.001)?;
/// assert_eq!(steps[1].acceleration, [5.0, 0.0, 0.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_trajectory(
    file: &str,
    bytes: &[u8],
    unit: f64,
) -> Result<Vec<MotionStep>, TrajectoryError> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(bytes);
    let at = |line: usize, what: String| TrajectoryError(format!("{file}:{line}: {what}"));
    let columns =
        "columns are ax, ay, az in m/s², and optionally gx, gy, gz in m/s², time in s, diameter";
    let head = |what: String| at(1, format!("{what}; {columns}"));
    let names = reader.headers().map_err(|e| head(e.to_string()))?.clone();
    check_names(&names).map_err(head)?;
    let mut out = Vec::new();
    for (i, record) in reader.records().enumerate() {
        let record = record.map_err(|e| at(i + 2, e.to_string()))?;
        let line = record
            .position()
            .and_then(|p| usize::try_from(p.line()).ok());
        let step = read_step(&names, &record, unit);
        out.push(step.map_err(|what| at(line.unwrap_or(i + 2), what))?);
    }
    match out.len() {
        1..=MOST => Ok(out),
        count => Err(TrajectoryError(format!(
            "{file}: {count} steps; give 1 to {MOST}"
        ))),
    }
}
