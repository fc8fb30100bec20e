//! Ranks over a stroke.

pub mod analysis;
pub mod request;
