//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod accuracy;
mod bytes;
mod catalogs;
mod certificates;
mod certify;
mod cli;
mod contours;
mod documents;
mod drawings;
mod drive;
mod drive_command;
mod exports;
mod grip;
mod holding;
mod layering;
mod mobility;
mod programmes;
mod published;
mod ranking;
mod reactions;
mod robot_bytes;
mod robot_mjcf;
mod robot_models;
mod robot_sdf;
mod robots;
mod statics;
mod stroke;
mod stroke_poses;
mod structure;
mod twin;
mod varied;
