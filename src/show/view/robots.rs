//! What is told of robot descriptions.

pub mod convert;
pub mod lint;
