//! MJCF, read, mended and written.

mod context;
mod defaults;
mod equality;
pub(super) mod fix;
mod include;
pub(super) mod read;
mod replicate;
mod weights;
pub(super) mod write;
