//! `ozols catalog`.

mod build;
mod chains;
mod drawn;
mod look;
mod merge;
mod task;
mod wanted;

use crate::cli::option::Global;
use crate::cli::terminal::Done;
use clap::{Args as ClapArgs, Subcommand};

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Catalog {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// How many chains, frames, drives and grippers there are.
    Count(chains::Count),
    /// The chains, by the codes that name them.
    Chains(chains::Chains),
    /// Lay out, search and score every structure, into a database; carries on where it was ended.
    Build(Box<build::Build>),
    /// Search mechanisms that were drawn, and keep them beside the structures.
    Search(drawn::SearchDrawn),
    /// Put the parts of a catalogue together.
    Merge(merge::Merge),
    /// What structure a mechanism has, what it is known as, and whether a catalogue has it.
    Find(look::Find),
    /// Ask a catalogue in SQL, or for its best structures.
    Query(look::Query),
    /// What a catalogue knows of a structure.
    Show(look::Show),
    /// A structure as a mechanism file, or one of its ideas carried out.
    Export(look::Export),
    /// A catalogue as one page to look at.
    Page(look::Page),
}

pub(in crate::cli) fn run(args: &Global, a: &Catalog) -> anyhow::Result<Done> {
    match &a.what {
        What::Count(c) => chains::count(args, c),
        What::Chains(c) => chains::list(c),
        What::Build(b) => build::run(args, b),
        What::Search(s) => drawn::search(args, s),
        What::Merge(m) => merge::merge(m),
        What::Find(f) => look::find(f),
        What::Query(q) => look::query(q),
        What::Show(s) => look::show(s),
        What::Export(e) => look::export(e),
        What::Page(p) => look::page(p),
    }
}
