//! What pictures stand on: the writer of elements, the room that text takes, points and rectangles.

pub mod plane;
pub mod text;
pub mod xml;
