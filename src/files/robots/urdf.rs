//! URDF, read, mended and written.

pub(super) mod fix;
mod gazebo;
pub(super) mod payload;
pub(super) mod read;
pub(super) mod write;
