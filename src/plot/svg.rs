//! Basis of all pictures: the writer of elements, the space that text takes, points and rectangles.

pub mod labels;
pub mod plane;
pub mod text;
pub mod xml;
