//! From text to a validated mechanism, with every problem found pointed at.

pub mod build;
pub mod joint_loads;
pub mod loads;
pub mod locate;
pub mod problem;
pub mod ranking;
mod resolve;
pub mod schema;
pub mod text;
