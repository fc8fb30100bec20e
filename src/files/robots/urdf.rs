//! URDF, read, mended and written.

pub(super) mod fix;
mod gazebo;
pub(super) mod read;
pub(super) mod write;
