//! MJCF, read and mended.

mod context;
mod defaults;
mod equality;
pub(super) mod fix;
mod include;
pub(super) mod read;
