//! Exact geometry: expressions with roots and rational-degree cosines, and their images in a prime field.

pub mod exact;
pub mod expr;
pub mod number_field;
pub mod scalars;
