//! Catalogues and chains for people, and as data.

pub mod chains;
#[cfg(feature = "cli")]
pub mod find;
pub mod pairs;
#[cfg(feature = "cli")]
pub mod structures;
