//! Rank of the closure matrix, with the certainty of each method's result.

pub mod exact;
pub mod finite;
pub mod method;
pub mod numeric;
pub mod reduce;
pub mod rounded;
pub mod stroke;
