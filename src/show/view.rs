//! Finished values as JSON and as text for people.

pub mod accuracy;
pub mod analysis;
pub(crate) mod assumed;
pub mod catalog;
pub(crate) mod claims;
pub mod contract;
pub mod drive;
pub mod grip;
pub mod lint;
pub mod reactions;
pub mod search;
pub mod statics;
pub mod stroke;
pub mod terminal;
