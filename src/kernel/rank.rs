//! Rank of the closure matrix, with what each method knows about its answer.

pub mod exact;
pub mod finite;
pub mod method;
pub mod numeric;
pub mod reduce;
pub mod rounded;
pub mod stroke;
