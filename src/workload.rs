//! What mechanisms are put to: loads, and the reactions they cause.

pub mod assur;
pub mod assur_class;
pub mod planar;
