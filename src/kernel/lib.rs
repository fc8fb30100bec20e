//! The kernel of ozols: exact geometry, the closure equations of a mechanism, their rank by every method, redundant
//! constraints contour by contour, and the search for what removes them.
//!
//! It knows neither files nor forces; `ozols` is the front door.

pub mod closure;
#[doc(hidden)]
pub mod format;
pub mod geom;
pub mod linalg;
pub mod meant;
pub mod model;
pub mod motion;
pub mod rank;
pub mod redundancy;
pub mod search;
pub mod shard;
pub mod verify;
