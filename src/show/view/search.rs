//! A search for people and programs: text, JSON, CSV.

pub mod costs;
pub(crate) mod counts;
pub mod csv;
pub mod json;
pub mod nothing_found;
pub(crate) mod numeric;
pub(crate) mod ranking;
pub(crate) mod second_opinion;
pub(crate) mod stopped_early;
pub mod text;
pub mod variant;
pub mod why;
