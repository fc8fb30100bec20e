//! Output of results: text, JSON and CSV, drawings, and pages.

use ozols_catalogue::chains;
#[cfg(feature = "store")]
use ozols_catalogue::{catalog, synthesis};
use ozols_evaluation::score;
use ozols_files::{file, robots};
use ozols_forces::{drive, grip, statics};
use ozols_kernel::{closure, format, geom, model, motion, rank, redundancy, search};
use ozols_plot::{chart, svg};

pub mod draw;
pub mod page;
pub mod terms;
pub mod view;
