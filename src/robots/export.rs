//! Mechanisms as other programs take them: the mechanism file again, robot descriptions, graphs.

pub use crate::file::write::mechanism_file;
pub use crate::robots::graph::{dot, graphml};
pub use crate::robots::sdf::write::sdf;
pub use crate::robots::urdf::write::urdf;

use thiserror::Error;

/// Why a mechanism cannot be written in a format.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The format has no such joint.
    #[error("joint \"{joint}\" of type {kind} cannot be said in {format}; {remedy}")]
    Joint {
        /// The joint.
        joint: String,
        /// Its type.
        kind: String,
        /// The format.
        format: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// The TOML writer failed.
    #[error("the mechanism cannot be written as TOML: {0}; report this with the file")]
    Toml(#[from] toml::ser::Error),
}

/// The mechanism file as TOML.
///
/// # Errors
/// Never for a validated mechanism, as far as is known.
pub fn toml(m: &crate::model::mechanism::Mechanism) -> Result<String, ExportError> {
    Ok(toml::to_string(&mechanism_file(m).json())?)
}
