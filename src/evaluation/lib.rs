//! What is made of many analyses and searches: scores and orders under a workload, and how right and how fast the methods are.

use ozols_files::file;
use ozols_forces::{grip, statics};
use ozols_kernel::{closure, format, geom, linalg, model, motion, rank, redundancy, search};
use ozols_plot::chart;

pub mod accuracy;
pub mod score;
