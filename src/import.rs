//! From text to a validated mechanism, with every problem found pointed at.

pub mod build;
mod coupling;
pub mod doubt;
pub mod drive;
pub mod findings;
pub mod grip;
pub mod joint_loads;
pub mod loads;
pub mod locate;
mod names;
pub mod problem;
mod quantity;
pub mod ranking;
mod resolve;
pub mod schema;
pub mod text;
mod unit;
pub mod workload;
