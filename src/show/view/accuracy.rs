//! How right and how fast methods and ways of searching are, for people and as data.

pub mod bench;
pub mod survey;
