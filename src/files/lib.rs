//! Input and output of mechanisms: mechanism files, robot descriptions, CAD assemblies.

use ozols_forces::statics;
use ozols_kernel::{closure, format, geom, linalg, model, motion, rank, redundancy};

pub mod file;
pub mod robots;
