//! Catalogues and chains for people, and as data.

pub mod chains;
#[cfg(feature = "store")]
pub mod find;
#[cfg(feature = "store")]
mod neighbours;
pub mod pairs;
#[cfg(feature = "store")]
pub mod structures;
