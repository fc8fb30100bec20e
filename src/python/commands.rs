//! Lint and fix of files, and the workloads of a mechanism.

use crate::answer::{Answer, failed, json};
use crate::mechanism::Mechanism;
use ozols::cli;
use ozols::drive::driving::design_drive;
use ozols::file::read::workload::{drive_from_bytes, grip_from_bytes};
use ozols::grip::analyse_grip;
use ozols::model::grip::Toward;
use ozols::view::drive::{Drive, text};
use ozols::view::grip::GripReport;
use pyo3::prelude::*;
use std::ffi::OsString;

/// Returns what `ozols lint` prints about files.
#[pyfunction]
pub(crate) fn lint(py: Python<'_>, words: Vec<OsString>) -> PyResult<Answer> {
    let (json, text) = py.detach(|| cli::lint(&words)).map_err(refused)?;
    Ok((json, text, None, None))
}

/// Does what `ozols fix` does, and returns its summary.
#[pyfunction]
pub(crate) fn fix(py: Python<'_>, words: Vec<OsString>) -> PyResult<String> {
    py.detach(|| cli::fix(&words)).map_err(refused)
}

fn refused(e: anyhow::Error) -> PyErr {
    failed(cli::error_text(&e))
}

/// Returns what `ozols grip` prints.
#[pyfunction]
pub(crate) fn grip(
    py: Python<'_>,
    mechanism: &Bound<'_, Mechanism>,
    accelerations: Vec<[f64; 3]>,
    any_acceleration: Option<f64>,
) -> PyResult<Answer> {
    let m = &mechanism.get().0;
    py.detach(|| {
        let mut file = grip_from_bytes(&name(m), file_text(m)?.as_bytes()).map_err(failed)?;
        let further = accelerations.into_iter().map(Toward::Fixed);
        let further: Vec<Toward> = further.chain(any_acceleration.map(Toward::Any)).collect();
        let fits = |t: &Toward| match t {
            Toward::Fixed(v) => v.iter().all(|x| x.abs() <= 1e6),
            Toward::Any(x) => (0.0..=1e6).contains(x),
        };
        if !further.iter().all(fits) {
            return Err(failed(
                "accelerations must be at most 1e6 m/s², and any_acceleration from 0 to 1e6",
            ));
        }
        match &mut file.spec.load {
            Some(load) => load.accelerations.extend(further),
            None if further.is_empty() => {}
            None => {
                return Err(failed(
                    "accelerations need a load: give [workload.grip] a mass and friction",
                ));
            }
        }
        let found = analyse_grip(&file.spec, file.mechanism.as_ref()).map_err(failed)?;
        let shown = GripReport {
            file: &file,
            found: &found,
            motion: None,
        };
        Ok((json(&shown.json())?, shown.text(None), None, None))
    })
}

/// Returns what `ozols drive` prints.
#[pyfunction]
pub(crate) fn drive(py: Python<'_>, mechanism: &Bound<'_, Mechanism>) -> PyResult<Answer> {
    let m = &mechanism.get().0;
    py.detach(|| {
        let file = drive_from_bytes(&name(m), file_text(m)?.as_bytes()).map_err(failed)?;
        let found = design_drive(&file.spec).map_err(failed)?;
        let shown = Drive::new(&file, &found);
        Ok((
            json(&shown.json())?,
            text::drive_text(&shown, None),
            None,
            None,
        ))
    })
}

fn name(m: &ozols::Mechanism) -> String {
    format!("{}.toml", m.name)
}

fn file_text(m: &ozols::Mechanism) -> PyResult<String> {
    ozols::export(m, "toml").map_err(failed)
}
