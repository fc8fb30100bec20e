//! Catalogues and chains for people, and as data.

pub mod counts;
#[cfg(feature = "store")]
pub mod find;
pub mod query;
#[cfg(feature = "store")]
pub mod structures;
