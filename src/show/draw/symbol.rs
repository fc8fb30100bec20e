//! Symbols of joints, gears and the frame.

pub(in crate::draw) mod drive;
pub(in crate::draw) mod ground;
pub(in crate::draw) mod pairs;
pub(in crate::draw) mod pieces;
pub(in crate::draw) mod placed;
pub(in crate::draw) mod symbols;
