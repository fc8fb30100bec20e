//! A search for people and programs: text, JSON, CSV.

pub(crate) mod counts;
pub mod csv;
pub mod json;
pub mod nothing_found;
pub(crate) mod numeric;
pub(crate) mod ranking;
pub(crate) mod second_opinion;
pub mod text;
pub mod variant;
pub mod why;
