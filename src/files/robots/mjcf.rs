//! MJCF, read, mended and written.

mod actuators;
mod context;
mod defaults;
mod equality;
pub(super) mod fix;
mod geoms;
mod include;
pub(super) mod payload;
pub(super) mod read;
mod replicate;
pub(super) mod write;
