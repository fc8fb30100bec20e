//! Reductions of the question: parts that can be taken one after another, and the vectors that choices add to the present joints.

pub(in crate::search) mod biconnected;
pub(in crate::search) mod lifetimes;
pub(in crate::search) mod self_stress_space;
