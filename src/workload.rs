//! What mechanisms are put to: loads and the reactions they cause, what a gripper must hold, and what drives it. Knows
//! geometry and statics, and nothing of files, searches or reports.

pub mod arm_charts;
pub mod assur;
pub mod assur_class;
pub mod clamping;
pub mod contact;
pub mod contour_group;
pub mod delta_point;
mod dense;
pub mod driving;
pub mod group_equilibrium;
pub mod holding;
pub mod jaw_loads;
pub mod kinetostatics;
pub mod lever_arm;
pub mod planar;
pub mod planar_motion;
pub mod pose;
pub mod programme;
pub mod projective;
pub mod reactions;
pub mod stability;
pub mod statics;
pub mod swing;
pub mod torsion;
pub mod transmission;
