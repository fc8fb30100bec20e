//! Symbols of joints, gears and the frame.

pub(crate) mod ground;
pub(crate) mod pieces;
pub(crate) mod placed;
pub(crate) mod symbols;
