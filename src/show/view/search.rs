//! A search for people and programs: text, JSON, CSV.

pub mod conditions;
pub mod costs;
mod counts;
pub mod csv;
pub mod data;
pub(in crate::view) mod ideas;
pub mod json;
pub mod numeric;
pub mod ranking;
pub mod second_opinion;
pub mod stopped_early;
pub(in crate::view) mod table;
pub mod text;
pub mod variant;
pub mod why;
