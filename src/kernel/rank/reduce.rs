//! The same rank from fewer rows: in a plane, and in the groups that contours move in.

pub mod axis_names;
pub(crate) mod plane;
pub mod sufficient_rows;
