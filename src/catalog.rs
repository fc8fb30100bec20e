//! Catalogues: every structure of a range of chains laid out, searched and scored, in a database that people can query.

pub mod build;
pub mod drawn;
#[cfg(feature = "cli")]
pub mod find;
#[cfg(feature = "cli")]
mod insert;
pub mod row;
pub mod spec;
#[cfg(feature = "cli")]
pub mod store;
