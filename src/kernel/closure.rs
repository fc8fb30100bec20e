//! Loop closure: which contours a mechanism has, and the matrix that says how joint speeds must agree round them.

pub(crate) mod connected;
pub mod contour;
pub mod coupling;
pub(crate) mod drive;
pub mod matrix;
pub mod mirror;
pub(crate) mod symmetry_image;
pub mod tree;
pub(crate) mod turn;
pub mod twist;
