//! `ozols catalog count` and `chains`.

use super::listing::Listing;
use super::pairs::PairArgs;
use crate::catalog::spec::range;
use crate::chains::census::census;
use crate::chains::enumerate::{ChainsError, chains, count_chains};
use crate::cli::done::Done;
use crate::cli::option::global::Global;
use crate::cli::terminal::output;
use crate::cli::terminal::progress::Bar;
use crate::view::catalog::chains::{CensusData, ChainData, census_text, chains_text};
use anyhow::ensure;
use clap::Args as ClapArgs;
use rayon::prelude::*;
use std::ops::RangeInclusive;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Count {
    /// Numbers of links: one, or a range such as 4..10, its end included.
    #[arg(long, value_name = "N..M", default_value = "4..8", value_parser = links)]
    links: RangeInclusive<usize>,
    /// Chains alone, not what their links can be: with 16 links and more that saves most of the time.
    #[arg(long)]
    chains: bool,
    #[command(flatten)]
    pairs: PairArgs,
    #[command(flatten)]
    listing: Listing,
}

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Chains {
    /// Number of links.
    #[arg(long, value_name = "N", default_value_t = 8)]
    links: usize,
    #[command(flatten)]
    listing: Listing,
}

/// Beyond so many links grippers are not counted: there are tens of millions.
const MOST_OF_GRIPPERS: usize = 12;
/// Beyond so many, chains are not listed: the list would not fit memory.
const MOST_LISTED: usize = 14;

fn links(text: &str) -> Result<RangeInclusive<usize>, String> {
    let all = range(text)
        .map_err(|part| format!("{part:?} is not a number of links: write 8 or 4..10"))?;
    if all.is_empty() || *all.start() < 3 || *all.end() > 18 {
        return Err(
            "chains of 4 to 18 links are counted, with --pairs of 3 to 10, from the lesser number to the greater"
                .to_owned(),
        );
    }
    Ok(all)
}

pub(super) fn count(args: &Global, a: &Count) -> anyhow::Result<Done> {
    let w = a.listing.mobility;
    ensure!((1..=6).contains(&w), "--mobility must be 1 to 6");
    let mut bar = Bar::new(args.quiet);
    if a.pairs.are_given() {
        return a.pairs.count(&a.links, a.chains, &a.listing, &mut bar);
    }
    ensure!(
        *a.links.start() > 3,
        "chains of hinges have 4 links at least: three links need --pairs"
    );
    let mut all = Vec::new();
    for (i, n) in a.links.clone().enumerate() {
        bar.step(&format!("{n} links"), i, a.links.clone().count());
        let found = if a.chains {
            count_chains(n, w).map(|chains| CensusData::of_chains(n, w, chains))
        } else {
            census(n, w, n <= MOST_OF_GRIPPERS).map(|c| CensusData::new(n, w, &c))
        };
        match found {
            Ok(found) => all.push(found),
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
    a.listing.give(&all, census_text)
}

pub(super) fn list(a: &Chains) -> anyhow::Result<Done> {
    ensure!(
        a.links <= MOST_LISTED,
        "chains of up to {MOST_LISTED} links are listed; `ozols catalog count --links {}` counts those",
        a.links
    );
    let found = chains(a.links, a.listing.mobility)?;
    let all: Vec<ChainData> = found.par_iter().map(ChainData::new).collect();
    a.listing.give(&all, chains_text)
}
