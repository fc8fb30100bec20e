//! What mechanisms are put to: loads, and the reactions they cause.

pub mod assur;
pub mod assur_class;
pub mod contour_group;
pub mod delta_point;
mod dense;
pub mod group_equilibrium;
pub mod kinetostatics;
pub mod planar;
pub mod planar_motion;
pub mod pose;
pub mod projective;
pub mod reactions;
pub mod stability;
pub mod statics;
