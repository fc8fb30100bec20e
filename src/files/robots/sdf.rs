//! SDF, read, mended and written.

pub(super) mod fix;
mod gearbox;
mod include;
pub(super) mod joints;
pub(super) mod read;
pub(super) mod scene;
pub(super) mod write;
