//! What pictures stand on: the writer of elements, the room that text takes, points and rectangles.

pub(crate) mod plane;
pub(crate) mod text;
pub(crate) mod xml;
