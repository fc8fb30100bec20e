//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod accuracy;
mod bytes;
mod catalogs;
mod certificates;
mod certify;
mod cli;
mod contours;
mod layering;
mod published;
mod structure;
mod twin;
mod varied;
