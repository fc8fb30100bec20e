//! Exact geometry: expressions with roots and rational-degree cosines, their images in a prime field, and the
//! number field they lie in.

pub mod exact;
pub(crate) mod exact_vector;
pub mod expr;
pub mod extent;
pub mod number_field;
pub mod rigid;
pub mod scalars;
pub mod vector;
