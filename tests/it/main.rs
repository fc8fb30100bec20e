//! Integration tests.
#![allow(clippy::unwrap_used, missing_docs, reason = "tests")]

mod accuracy;
mod bench;
mod catalogs;
mod catalogue;
mod charts;
mod claims;
mod cli;
mod common;
mod contours;
mod couplings;
mod documents;
mod drawings;
mod drive;
mod drive_faults;
mod examples;
mod first_hour;
mod fuzz;
mod grip;
mod layering;
mod library;
mod licences;
mod phrases;
mod published;
mod rank;
mod ranking;
mod reactions;
mod report_page;
mod robots;
mod search;
mod shared_builds;
mod sources;
mod statics;
mod structure;
mod studio;
mod tables;
