//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod bytes;
mod catalogs;
mod certificates;
mod certify;
mod cli;
mod contours;
mod drawings;
mod exports;
mod layering;
mod mobility;
mod published;
mod robot_bytes;
mod robot_mjcf;
mod robot_models;
mod robot_sdf;
mod robots;
mod statics;
mod stroke;
mod structure;
mod twin;
mod varied;
