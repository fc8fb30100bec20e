//! Reductions of the question: parts that can be solved one after another, and the vectors that choices add to the original
//! joints.

pub(in crate::search) mod biconnected;
pub(in crate::search) mod lifetimes;
pub(in crate::search) mod self_stress_space;
