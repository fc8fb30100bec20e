//! The extension module of the Python package: it calls the library and returns its views as JSON. The package `ozols` next to
//! this file turns them into objects.

mod analysis;
mod answer;
mod catalog;
mod commands;
mod mechanism;
mod search;
mod statics;

/// The module `ozols._native`.
#[pyo3::pymodule]
mod _native {
    use pyo3::prelude::*;
    use std::ffi::OsString;

    #[pymodule_export]
    use crate::analysis::{analyze, stroke};
    #[pymodule_export]
    use crate::answer::Error;
    #[pymodule_export]
    use crate::catalog::{catalog_build, catalog_merge, catalog_plan};
    #[pymodule_export]
    use crate::commands::{drive, fix, grip, lint};
    #[pymodule_export]
    use crate::mechanism::{Mechanism, builtin_names};
    #[pymodule_export]
    use crate::search::{Outcome, Variant, Variants, search};
    #[pymodule_export]
    use crate::statics::statics;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// Runs the command `ozols` with these words, its name first, and returns the exit code.
    #[pyfunction]
    fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
        py.detach(|| ozols::cli::run_with(words))
    }
}
