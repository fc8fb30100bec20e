//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod bytes;
mod catalogs;
mod certificates;
mod certify;
mod cli;
mod contours;
mod layering;
mod published;
mod statics;
mod structure;
mod twin;
mod varied;
