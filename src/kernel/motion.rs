//! Poses of closed mechanisms, and mechanisms followed along a drive.

pub mod close;
pub mod drive_range;
pub mod follow;
pub mod jaws;
pub mod pose;
pub mod working;
