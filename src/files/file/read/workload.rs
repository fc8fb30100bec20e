//! Reading the workload tables of a file, with or without a mechanism around them.

pub(crate) mod drive;
pub(crate) mod grip;
pub(crate) mod loads;
pub mod motion;
pub mod trajectory;

use crate::file::prelude::*;
use crate::file::problem::ImportError;
use crate::file::read::value::{length_unit, with_parameters};
use crate::file::read::workload::drive::read_drive;
use crate::file::read::workload::grip::read_grip;
use crate::file::read::{build_mechanism, read_claims};
use crate::file::text::{read_file, text_of};
use crate::model::claim::Claim;
use crate::model::drive::DriveSpec;
use crate::model::grip::GripSpec;
use crate::model::mechanism::LengthUnit;

/// A file as the workload commands see it.
#[derive(Debug, Clone)]
pub struct WorkloadFile<T> {
    /// Short name.
    pub name: String,
    /// The sources of the figures.
    pub sources: Vec<String>,
    /// Unit of the file's lengths, for labels.
    pub length_unit: LengthUnit,
    /// Claims of publications about it.
    pub claims: Vec<Claim>,
    /// The mechanism, if the file has links or joints.
    pub mechanism: Option<Mechanism>,
    /// The content of the table, in SI units.
    pub spec: T,
}

/// Reads `[workload.grip]`; names that end in `.json` are JSON, all others TOML.
///
/// # Errors
/// Returns every problem found, each with its place.
///
/// # Examples
/// ```
/// use ozols::file::read::workload::grip_from_bytes;
/// let text = ozols::builtin::text("lever-gripper").unwrap_or_default();
/// let file = grip_from_bytes("lever-gripper.toml", text.as_bytes())?;
/// assert!(file.spec.lever_length > 0.0 && !file.claims.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn grip_from_bytes(name: &str, bytes: &[u8]) -> Result<WorkloadFile<GripSpec>, ImportError> {
    let example = ("grip", "lever-gripper");
    let text = text_of(name, bytes)?;
    read_file(name, text, |file| read_workload(file, read_grip, example))
}

/// Reads `[workload.drive]`; names that end in `.json` are JSON, all others TOML.
///
/// # Errors
/// Returns every problem found, each with its place.
///
/// # Examples
/// ```
/// use ozols::file::read::workload::drive_from_bytes;
/// let text = ozols::builtin::text("torsion-module").unwrap_or_default();
/// let file = drive_from_bytes("torsion-module.toml", text.as_bytes())?;
/// assert!(file.mechanism.is_some() && file.spec.shear_modulus > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn drive_from_bytes(name: &str, bytes: &[u8]) -> Result<WorkloadFile<DriveSpec>, ImportError> {
    let example = ("drive", "torsion-module");
    let text = text_of(name, bytes)?;
    read_file(name, text, |file| read_workload(file, read_drive, example))
}

/// Reads a file that has workload tables and no mechanism: its name and those of its tables; `None` for other files.
///
/// # Errors
/// Returns every problem found, each with its place.
pub fn tables_alone(
    name: &str,
    bytes: &[u8],
) -> Result<Option<(String, Vec<&'static str>)>, ImportError> {
    read_file(name, text_of(name, bytes)?, |file| {
        let tables = workload_tables(file);
        if tables.is_empty() || !file.link.is_empty() || !file.joint.is_empty() {
            return Ok(None);
        }
        let out = with_parameters(file);
        let unit = length_unit(file, &out).metres;
        read_grip(file, unit, None, &out);
        read_drive(file, unit, None, &out);
        out.finish(Some((file.name.clone(), tables)))
    })
}

/// Returns the names of the independent tables that a file has.
pub(crate) fn workload_tables(file: &MechanismFile) -> Vec<&'static str> {
    let grip = file.workload.grip.as_ref().map(|_| "grip");
    let drive = file.workload.drive.as_ref().map(|_| "drive");
    grip.into_iter().chain(drive).collect()
}

fn read_workload<T>(
    file: &MechanismFile,
    table: impl Fn(&MechanismFile, f64, Option<&Parts>, &Findings) -> Option<T>,
    (name, example): (&str, &str),
) -> Result<WorkloadFile<T>, Vec<Finding>> {
    let out = with_parameters(file);
    let alone = file.link.is_empty() && file.joint.is_empty();
    let mechanism = (!alone).then(|| build_mechanism(file)).transpose()?;
    let length_unit = length_unit(file, &out);
    let spec = table(file, length_unit.metres, mechanism.as_deref(), &out);
    let claims = read_claims(file, &out);
    if spec.is_none() && out.problem_count() == 0 {
        out.key("workload").add_problem(format!(
            "the file has no [workload.{name}] table; `ozols show {example}` prints one to start from"
        ));
    }
    let Some(spec) = spec else {
        return Err(out.into_findings());
    };
    out.finish(WorkloadFile {
        name: file.name.clone(),
        sources: file.sources.clone(),
        claims,
        length_unit,
        mechanism,
        spec,
    })
}
