//! Loop closure: which contours a mechanism has, and the matrix that says how joint speeds must agree round them.

pub mod contour;
pub mod coupling;
pub mod image;
pub mod matrix;
pub mod mirror;
pub(crate) mod tied;
pub mod tree;
pub mod turn;
pub mod twist;
