//! What is asked: the space of variants, what they must be like, what they cost, and the mechanism made ready for it.

pub mod as_written;
pub mod conditions;
pub mod cost;
pub mod grasp;
pub mod rounded_rank;
pub mod space;
pub mod symmetry;
