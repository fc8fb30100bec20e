//! Catalogues: every structure of a range of chains laid out, searched and scored, in a database that people can query.

pub mod build;
pub mod drawn;
#[cfg(feature = "store")]
pub mod find;
#[cfg(feature = "store")]
mod insert;
pub mod row;
pub mod spec;
#[cfg(feature = "store")]
pub mod store;
