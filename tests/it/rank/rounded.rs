//! Coordinates that were turned and rounded: right or undecided, never wrong and sure.
//!
//! A seeded part of the cases by default; all of them, with the table of the guide, by
//! `OZOLS_ROUNDED=all cargo test --test integration rounded::table -- --nocapture`.

pub(crate) mod cases;
mod digits;
mod doubted;
mod families;
mod law;
mod nearly_special;
mod program;
mod ranges;
mod search_numeric;
mod second_opinion;
mod shown;
mod symmetry;
mod table;
mod units;
