//! What is told of robot descriptions.

pub mod lint;
