//! The extension module of the Python package: it calls the library and returns its views as JSON. The package `ozols` next to
//! this file turns them into objects.

mod answer;
mod catalog;
mod mechanism;
mod search;

/// The module `ozols._native`.
#[pyo3::pymodule]
mod _native {
    use crate::answer::failed;
    use ozols::cli;
    use pyo3::prelude::*;
    use std::ffi::OsString;

    #[pymodule_export]
    use crate::answer::Error;
    #[pymodule_export]
    use crate::catalog::{catalog_build, catalog_merge, catalog_plan};
    #[pymodule_export]
    use crate::mechanism::{Mechanism, builtin_names};
    #[pymodule_export]
    use crate::search::{Outcome, Variant, Variants, search};

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// Runs the command `ozols` with these words, its name first, and returns the exit code.
    #[pyfunction]
    fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
        py.detach(|| cli::run_with(words))
    }

    /// Returns what a command prints about files, or about a mechanism for which `-` stands.
    #[pyfunction]
    #[pyo3(signature = (words, mechanism=None))]
    fn printed(
        py: Python<'_>,
        words: Vec<OsString>,
        mechanism: Option<&Bound<'_, Mechanism>>,
    ) -> PyResult<String> {
        let file = match mechanism.map(|m| m.get()) {
            Some(m) => Some((format!("{}.toml", m.0.name), m.export(py, "toml")?)),
            None => None,
        };
        py.detach(|| cli::printed(&words, file))
            .map_err(|e| failed(cli::error_text(&e)))
    }
}
