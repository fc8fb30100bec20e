//! MJCF, read.

mod defaults;
mod equality;
mod include;
pub(super) mod read;
