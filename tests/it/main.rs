//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod bytes;
mod catalogs;
mod cli;
mod contours;
mod exports;
mod layering;
mod published;
mod robot_bytes;
mod robots;
mod twin;
