//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod catalogs;
mod contours;
mod layering;
