//! Results of many analyses and searches: scores and rankings under a workload, and the accuracy and speed of the methods.

use ozols_files::file;
use ozols_forces::{grip, statics};
use ozols_kernel::{closure, format, geom, linalg, model, motion, rank, redundancy, search};
use ozols_plot::chart;

pub mod accuracy;
pub mod score;
