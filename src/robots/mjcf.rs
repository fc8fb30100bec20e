//! MJCF, read.

mod context;
mod defaults;
mod equality;
mod include;
pub(super) mod read;
