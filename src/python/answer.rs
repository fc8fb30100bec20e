//! Answers for Python: a view as JSON and as the text of the command, with CSV and SVG if it has them.

use ozols::model::mechanism::{Mechanism, StateId};
use pyo3::PyResult;
use pyo3::exceptions::PyValueError;
use serde::Serialize;
use std::fmt::Display;

pyo3::create_exception!(
    ozols,
    Error,
    PyValueError,
    "An error of the library. Its text names the keywords of the call."
);

/// JSON, text, CSV, SVG.
pub(crate) type Answer = (String, String, Option<String>, Option<String>);

/// Returns an error of the library as an exception. Options in its text become keywords.
pub(crate) fn failed(e: impl Display) -> pyo3::PyErr {
    Error::new_err(keywords(&e.to_string()))
}

/// Returns a text with each option as the keyword of Python: `--max-mobility` becomes `max_mobility`.
fn keywords(text: &str) -> String {
    let mut parts = text.split("--");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| c != '-' && !c.is_ascii_lowercase());
        let (name, rest) = part.split_at(end.unwrap_or(part.len()));
        match name {
            "" => out += "--",
            name => out += &name.replace('-', "_"),
        }
        out += rest;
    }
    out
}

/// Returns the same with the lines of the file that the error is about.
pub(crate) fn refused(e: ozols::Error) -> pyo3::PyErr {
    match e {
        ozols::Error::File(problems) => failed(problems.render(false)),
        other => failed(other),
    }
}

/// Returns a view as JSON.
pub(crate) fn json(view: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(view).map_err(failed)
}

/// Returns a state by name.
pub(crate) fn state(m: &Mechanism, name: &str) -> PyResult<StateId> {
    m.state_named(name).ok_or_else(|| {
        let known = m.states.join(", ");
        failed(format!("{} has no state {name}; it has: {known}", m.name))
    })
}
