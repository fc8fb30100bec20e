//! The kernel of ozols: exact geometry, the closure equations of a mechanism, and their rank by every method. It also
//! finds redundant constraints contour by contour, and searches for redesigns that remove them.
//!
//! It contains no file formats and no forces; `ozols` is the main crate.

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
