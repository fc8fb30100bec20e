//! The same question in less: parts that can be taken one after another, and the rows of the closure equations that matter.

pub(in crate::search) mod biconnected;
pub(in crate::search) mod plane_split;
