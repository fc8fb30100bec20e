//! Results of many analyses and searches: scores and rankings under a workload.

use ozols_files::file;
use ozols_forces::{grip, statics};
use ozols_kernel::{closure, format, geom, model, motion, rank, redundancy, search};

pub mod score;
