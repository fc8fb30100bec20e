//! Statics of mechanisms: Assur groups and their kinetostatics, and joint reactions of any mechanism, planar or spatial.
//! Knows geometry and motion, and nothing of files, searches or reports.
//!
//! [`solve::solve`] takes a mechanism to its reactions: in its plane ([`cycle`]) where that determines them, otherwise in
//! space ([`reactions`]).

pub mod assur;
pub mod assur_class;
pub(crate) mod cone_programme;
pub mod contour_group;
pub mod cycle;
mod dense;
pub mod inertia;
pub mod kinetostatics;
pub mod planar;
pub mod planar_motion;
pub mod pose;
pub mod reaction;
pub mod reactions;
mod rounding;
pub mod solve;
pub mod transmission;
