//! Catalogues: every structure of a range of chains laid out, searched and scored, in a database that people can query.

pub mod build;
pub mod drawn;
#[cfg(feature = "store")]
mod entered;
#[cfg(feature = "store")]
pub mod find;
pub mod general;
#[cfg(feature = "store")]
mod insert;
#[cfg(feature = "store")]
pub mod neighbours;
pub(crate) mod paired_row;
#[cfg(feature = "store")]
mod prices;
pub mod row;
mod searched;
pub mod spec;
#[cfg(feature = "store")]
pub mod store;
