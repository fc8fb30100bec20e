//! The forces of a mechanism: Assur groups and reactions, grips, and the drive of two discs.

use ozols_kernel::{closure, format, geom, model, motion};

pub mod drive;
pub mod grip;
pub mod statics;
