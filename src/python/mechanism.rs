//! Mechanisms: reading, writing and drawing.

use crate::answer::{failed, refused, state};
use ozols::draw::{self, Marks, Subject};
use ozols::redundancy::analysis::{Method, analyse_states};
use ozols::robots::{self, Options};
use pyo3::prelude::*;
use std::path::PathBuf;

/// A mechanism of the library.
#[derive(Debug)]
#[pyclass(frozen, module = "ozols._native")]
pub(crate) struct Mechanism(pub(crate) ozols::Mechanism);

#[pymethods]
impl Mechanism {
    #[staticmethod]
    fn builtin(name: &str) -> PyResult<Self> {
        ozols::built_in(name).map(Self).map_err(refused)
    }

    /// Reads a mechanism file, or a robot description with its doubts.
    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<(Self, String)> {
        if robots::is_description(&path.display().to_string()) {
            return robot(py, path, &Options::default());
        }
        let read = py.detach(|| ozols::open(path));
        Ok((Self(read.map_err(refused)?), String::new()))
    }

    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        ozols::from_toml(text).map(Self).map_err(refused)
    }

    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        ozols::from_json(text).map(Self).map_err(refused)
    }

    /// Reads a robot description with the options in JSON, and the name and bytes of a file of loop closures.
    #[staticmethod]
    fn from_robot(
        py: Python<'_>,
        path: PathBuf,
        asked: &str,
        loops: Option<(String, Vec<u8>)>,
    ) -> PyResult<(Self, String)> {
        let options: Options = serde_json::from_str(asked).map_err(failed)?;
        robot(py, path, &Options { loops, ..options })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    pub(crate) fn export(&self, py: Python<'_>, format: &str) -> PyResult<String> {
        py.detach(|| ozols::export(&self.0, format)).map_err(failed)
    }

    fn draw(&self, py: Python<'_>, kind: &str, state: &str) -> PyResult<String> {
        py.detach(|| drawn(&self.0, kind, state, None))
    }
}

fn robot(py: Python<'_>, path: PathBuf, options: &Options) -> PyResult<(Mechanism, String)> {
    let imported = py
        .detach(|| ozols::import(path, options))
        .map_err(refused)?;
    Ok((Mechanism(imported.mechanism), imported.report.list_doubts()))
}

/// Returns a drawing of a mechanism in a state, with the changes of a redesign marked.
pub(crate) fn drawn(
    m: &ozols::Mechanism,
    kind: &str,
    named: &str,
    marks: Option<Marks>,
) -> PyResult<String> {
    let draw = match kind {
        "scheme" => draw::scheme,
        "kinematic" => draw::kinematic,
        _ => {
            return Err(failed(format!(
                "kind must be scheme or kinematic, not {kind:?}"
            )));
        }
    };
    let state = state(m, named)?;
    let found = analyse_states(m, &[state], Method::Auto).map_err(failed)?;
    let subject = Subject {
        mechanism: m,
        state,
        analysis: found.first(),
        marks,
    };
    Ok(draw(&subject).svg)
}

/// Returns the names of the built-in mechanisms, ascending.
#[pyfunction]
pub(crate) fn builtin_names() -> Vec<&'static str> {
    ozols::builtin::names()
}
