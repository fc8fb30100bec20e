//! Catalogues of grippers: chains up to isomorphism, places for their joints, and rows of results in a database.

use ozols_evaluation::score;
use ozols_files::file;
#[cfg(feature = "store")]
use ozols_kernel::format;
use ozols_kernel::{closure, geom, linalg, model, rank, redundancy, search, shard};

pub mod catalog;
pub mod chains;
pub mod synthesis;
