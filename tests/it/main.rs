//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod bytes;
mod catalogs;
mod certify;
mod cli;
mod contours;
mod layering;
mod published;
mod stroke;
mod twin;
mod varied;
