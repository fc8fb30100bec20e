//! ozols for Python: the library's calls on the one side, JSON of its views on the other. The package `ozols` beside this
//! file makes Python's own objects of that.

mod analysis;
mod catalog;
mod chart;
mod mechanism;
mod search;
mod statics;
mod told;
mod waiting;

/// What Python imports as `ozols._native`.
#[pyo3::pymodule]
mod _native {
    use pyo3::prelude::*;
    use std::ffi::OsString;

    #[pymodule_export]
    use crate::analysis::{analyze, stroke};
    #[pymodule_export]
    use crate::catalog::{catalog_build, catalog_merge, catalog_plan};
    #[pymodule_export]
    use crate::chart::chart;
    #[pymodule_export]
    use crate::mechanism::{Mechanism, builtin_names};
    #[pymodule_export]
    use crate::search::{Outcome, Variant, Variants, search};
    #[pymodule_export]
    use crate::statics::statics;
    #[pymodule_export]
    use crate::told::Error;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// The command `ozols` with these words, its name first; its exit code.
    #[pyfunction]
    fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
        py.detach(|| ozols::cli::run_with(words))
    }
}
