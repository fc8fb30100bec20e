//! Poses of closed mechanisms, and mechanisms followed along a drive.

pub mod follow;
pub mod pose;
