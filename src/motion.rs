//! Poses of closed mechanisms, and mechanisms followed along a drive.

pub mod close;
pub mod follow;
pub mod jaws;
pub mod pose;
pub mod way;
pub mod working;
