//! The table of a sweep: JSON lines, first what was asked, then a row a sample in order of the samples, then how many rows there
//! are and their digest.
//!
//! Rows are added at the end as they are made, so that a table that was ended at any moment is the beginning of the whole one,
//! and is carried on. Its bytes depend on nothing but the sweep and the part.

mod error;
mod head;
mod lines;
mod make;
mod merge;
mod rows;

pub use error::TableError;
pub use head::Head;
pub use lines::read;
pub use make::{SweepWatch, make};
pub use merge::merge;
pub use rows::Table;
