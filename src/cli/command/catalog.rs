//! `ozols catalog`.

mod build;
mod chains;
mod look;
mod merge;
mod task;
mod wanted;

use crate::cli::prelude::*;
use clap::Subcommand;

#[derive(Debug, ClapArgs)]
pub(crate) struct Catalog {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Count chains, frames, drives and grippers.
    Count(chains::Count),
    /// List the chains by their codes.
    Chains(chains::Chains),
    /// Lay out, search and score every structure and store it in a database; resumes an interrupted build.
    Build(Box<build::Build>),
    /// Merge the parts of a catalogue.
    Merge(merge::Merge),
    /// Find the structure of a mechanism, its known name, and its entry in a catalogue.
    Find(look::Find),
    /// Query a catalogue in SQL, or list its best structures.
    Query(look::Query),
    /// Show what a catalogue contains about a structure.
    Show(look::Show),
    /// Export a structure as a mechanism file, optionally with an idea applied.
    Export(look::Export),
    /// Write a catalogue as one HTML page.
    Page(look::Page),
}

pub(crate) fn run_catalog(args: &Global, a: &Catalog) -> anyhow::Result<Done> {
    match &a.what {
        What::Count(c) => chains::count(args, c),
        What::Chains(c) => chains::list(c),
        What::Build(b) => build::run_build(args, b),
        What::Merge(m) => merge::run_merge(m),
        What::Find(f) => look::run_find(f),
        What::Query(q) => look::run_query(q),
        What::Show(s) => look::run_show(s),
        What::Export(e) => look::run_export(e),
        What::Page(p) => look::run_page(p),
    }
}
