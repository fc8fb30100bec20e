//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod bytes;
mod catalogs;
mod certificates;
mod certify;
mod cli;
mod contours;
mod drive;
mod drive_command;
mod grip;
mod holding;
mod layering;
mod published;
mod statics;
mod structure;
mod twin;
mod varied;
