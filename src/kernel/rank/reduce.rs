//! The same rank from fewer rows: in a plane, and in the displacement groups of contours.

pub mod axis_names;
pub(crate) mod plane;
pub mod sufficient_rows;
