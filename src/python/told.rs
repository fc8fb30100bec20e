//! What is told to Python: a view as JSON, as the command's text, and as CSV and SVG where it has those.

use ozols::model::mechanism::{Mechanism, StateId};
use pyo3::PyResult;
use pyo3::exceptions::PyValueError;
use serde::Serialize;
use std::fmt::Display;

pyo3::create_exception!(
    ozols,
    Error,
    PyValueError,
    "What went wrong, in the words of the command line."
);

/// JSON, text, CSV, SVG.
pub(crate) type Told = (String, String, Option<String>, Option<String>);

/// An error of the library as an exception with its text.
pub(crate) fn failed(e: impl Display) -> pyo3::PyErr {
    Error::new_err(e.to_string())
}

/// The same with the lines of the file that it is about, as the command shows them.
pub(crate) fn refused(e: ozols::Error) -> pyo3::PyErr {
    match e {
        ozols::Error::File(problems) => failed(problems.render(false)),
        other => failed(other),
    }
}

/// A view as JSON.
pub(crate) fn json(view: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(view).map_err(failed)
}

/// A state by name.
pub(crate) fn state(m: &Mechanism, name: &str) -> PyResult<StateId> {
    m.state(name).ok_or_else(|| {
        let known = m.states.join(", ");
        failed(format!("{} has no state {name}; it has: {known}", m.name))
    })
}
