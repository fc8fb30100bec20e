//! SDF, read, mended and written.

pub(super) mod fix;
mod gearbox;
mod include;
mod joints;
pub(super) mod payload;
pub(super) mod read;
mod scene;
pub(super) mod write;
