//! Mechanisms as other programs take them: the mechanism file again, robot descriptions, graphs.

mod drive;
mod file;
mod graph;
mod grip;
mod mimic;
mod parts;
mod quantity;
mod ranking;
mod sdf;
mod urdf;

pub use file::mechanism_file;
pub use graph::{dot, graphml};
pub use sdf::sdf;
pub use urdf::urdf;

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
