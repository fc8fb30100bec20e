//! Coordinates that are rounded: what was meant by them, and whether the digits decide the rank.

pub mod intended;
pub mod moves;
pub mod nearest_lower_rank;
pub mod snap;
pub mod verdict;
