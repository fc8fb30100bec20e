//! MJCF, read.

mod defaults;
mod equality;
pub(super) mod include;
pub(super) mod read;
