//! Statics of mechanisms: Assur groups and their kinetostatics, and joint reactions of any mechanism, planar or spatial.
//! Knows geometry and motion, and nothing of files, searches or reports.

pub mod assur;
pub mod assur_class;
pub mod contour_group;
pub mod cycle;
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
pub mod transmission;
