//! `ozols catalog`.

mod build;
mod look;

use super::args::Args;
use super::progress::Bar;
use super::{Done, output};
use crate::chains::census::census;
use crate::chains::enumerate::{ChainsError, chains};
use crate::format::csv::records;
use crate::view::catalog::{CensusData, ChainData, census_text, chains_text};
use anyhow::ensure;
use clap::{Args as ClapArgs, Subcommand, ValueEnum, ValueHint};
use rayon::prelude::*;
use serde::Serialize;
use std::ops::RangeInclusive;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(super) struct Catalog {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// How many chains, frames, drives and grippers there are.
    Count(Count),
    /// The chains, by the codes that name them.
    Chains(Chains),
    /// Lay out, search and score every structure, into a database; carries on where it was ended.
    Build(build::Build),
    /// Put the parts of a catalogue together.
    Merge(build::Merge),
    /// Ask a catalogue in SQL, or for its best structures.
    Query(look::Query),
    /// What a catalogue knows of a structure.
    Show(look::Show),
    /// A structure as a mechanism file, or one of its ideas carried out.
    Export(look::Export),
    /// A catalogue as one page to look at.
    Page(look::Page),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CatalogFormat {
    Text,
    Json,
    Csv,
}

#[derive(Debug, ClapArgs)]
struct Common {
    /// Mobility of the chains, all of whose joints have one freedom.
    #[arg(long, value_name = "W", default_value_t = 1)]
    mobility: usize,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: CatalogFormat,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: Option<PathBuf>,
}

impl Common {
    /// Writes what was found, one row each, or as `text` for a terminal of some width.
    fn give<T: Serialize>(
        &self,
        all: &[T],
        text: impl Fn(&[T], Option<u16>) -> String,
    ) -> anyhow::Result<Done> {
        let path = self.output.as_deref();
        output::to(path, |out| {
            match self.format {
                CatalogFormat::Text => write!(out, "{}", text(all, output::width(path)))?,
                CatalogFormat::Json => output::json(out, &all)?,
                CatalogFormat::Csv => write!(out, "{}", records(all))?,
            }
            Ok(Done::Found)
        })
    }
}

#[derive(Debug, ClapArgs)]
struct Count {
    /// Numbers of links: one, or a range such as 4..10, its end included.
    #[arg(long, value_name = "N..M", default_value = "4..8", value_parser = links)]
    links: RangeInclusive<usize>,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, ClapArgs)]
struct Chains {
    /// Number of links.
    #[arg(long, value_name = "N", default_value_t = 8)]
    links: usize,
    #[command(flatten)]
    common: Common,
}

/// Beyond so many links grippers are not counted: there are tens of millions.
const MOST_OF_GRIPPERS: usize = 12;
/// Beyond so many, chains are not listed: the list would not fit memory.
const MOST_LISTED: usize = 14;

fn links(text: &str) -> Result<RangeInclusive<usize>, String> {
    let number = |t: &str| {
        let n = t.trim().parse::<usize>();
        n.map_err(|_| format!("{t:?} is no number of links: write 8 or 4..10"))
    };
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let to = to.strip_prefix('=').unwrap_or(to);
    let (from, to) = (number(from)?, number(to)?);
    if from > to || from < 4 || to > 18 {
        return Err(
            "chains of 4 to 18 links are counted, from the lesser number to the greater".to_owned(),
        );
    }
    Ok(from..=to)
}

pub(super) fn run(args: &Args, a: &Catalog) -> anyhow::Result<Done> {
    match &a.what {
        What::Count(count) => self::count(args, count),
        What::Chains(chains) => list(chains),
        What::Build(b) => build::run(args, b),
        What::Merge(m) => build::merge(m),
        What::Query(q) => look::query(q),
        What::Show(s) => look::show(s),
        What::Export(e) => look::export(e),
        What::Page(p) => look::page(p),
    }
}

fn count(args: &Args, a: &Count) -> anyhow::Result<Done> {
    let w = a.common.mobility;
    ensure!((1..=6).contains(&w), "--mobility must be 1 to 6");
    let mut bar = Bar::new(args.quiet);
    let mut all = Vec::new();
    for (i, n) in a.links.clone().enumerate() {
        bar.step(&format!("{n} links"), i, a.links.clone().count());
        match census(n, w, n <= MOST_OF_GRIPPERS) {
            Ok(found) => all.push(CensusData::new(n, w, &found)),
            // Every other number of links has no whole number of joints.
            Err(ChainsError::Parity { .. }) => {}
            Err(e) => return Err(e.into()),
        }
    }
    bar.clear();
    if all.is_empty() {
        output::note(&format!(
            "no chain with that number of links has the mobility {w}: 3(n - 1) - {w} must be even\n"
        ));
        return Ok(Done::Nothing);
    }
    a.common.give(&all, census_text)
}

fn list(a: &Chains) -> anyhow::Result<Done> {
    ensure!(
        a.links <= MOST_LISTED,
        "chains of up to {MOST_LISTED} links are listed; `ozols catalog count --links {}` counts those",
        a.links
    );
    let found = chains(a.links, a.common.mobility)?;
    let all: Vec<ChainData> = found.par_iter().map(ChainData::new).collect();
    a.common.give(&all, chains_text)
}
