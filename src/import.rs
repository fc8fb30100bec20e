//! From text to a validated mechanism, with every problem found pointed at.

pub mod build;
pub mod doubt;
pub mod drive;
pub mod grip;
pub mod joint_loads;
pub mod loads;
pub mod locate;
pub mod problem;
mod quantity;
pub mod ranking;
mod resolve;
pub mod schema;
pub mod text;
pub mod workload;
