//! SDF, read and written.

mod joints;
pub(super) mod read;
mod scene;
pub(super) mod write;
