//! What mechanisms are put to: loads, and the reactions they cause.

pub mod assur;
pub mod assur_class;
mod dense;
pub mod kinetostatics;
pub mod planar;
pub mod planar_motion;
pub mod pose;
