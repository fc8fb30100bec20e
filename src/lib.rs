//! ozols finds the redundant constraints of a mechanism, contour by contour, and every way of
//! removing them without changing the working motion.

pub mod builtin;
pub mod cli;
pub mod closure;
pub mod geom;
pub mod import;
pub mod linalg;
pub mod model;
pub mod rank;
pub mod redundancy;
pub mod report;
pub mod search;
