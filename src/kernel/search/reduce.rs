//! The same question in less: parts that can be taken one after another, the rows of the closure equations that matter, and what
//! choices add to the present joints.

pub(in crate::search) mod biconnected;
pub(in crate::search) mod lifetimes;
pub(in crate::search) mod self_stress_space;
