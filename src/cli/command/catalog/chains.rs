//! `ozols catalog count` and `chains`, for hinges only and for other pairs.

use crate::catalog::spec::parse_range;
use crate::chains::PairKind;
use crate::chains::census::{count_hinged, pair_census};
use crate::chains::enumerate::{ChainsError, count_chains, list_chains};
use crate::chains::sharing::Menu;
use crate::cli::prelude::*;
use crate::view::catalog::counts::{
    CountRow, chain_row, chains_text, hinged_row, hinged_text, pair_rows, pair_text,
};
use crate::view::catalog::query::QueryAnswer;
use rayon::prelude::*;
use std::ops::RangeInclusive;

#[derive(Debug, ClapArgs)]
struct PairArgs {
    /// Include chains with other pairs than hinges: slide, gear (or rack), slot (pin in a slot, cam, wedge), two-slots (two pins
    /// in two slots between the same links).
    #[arg(long, value_name = "KINDS", value_delimiter = ',', value_parser = parse_pair_kind)]
    pairs: Vec<PairKind>,
    /// Maximum number of pairs that are not hinges.
    #[arg(long, value_name = "K", default_value_t = 3, requires = "pairs")]
    at_most: usize,
}

pub(super) fn parse_pair_kind(word: &str) -> Result<PairKind, String> {
    let others = PairKind::ALL.iter().filter(|k| k.0 != PairKind::Hinge);
    let found = others.clone().find(|k| k.1 == word).map(|k| k.0);
    found.ok_or_else(|| {
        let known = others.map(|k| k.1).join(", ");
        format!("{word:?} is none of {known}; hinges are always included")
    })
}

/// Largest number of links for which chains are counted one by one.
const MOST_LINKS: usize = 10;

impl PairArgs {
    /// Returns true if pairs are asked for.
    fn are_given(&self) -> bool {
        !self.pairs.is_empty()
    }

    /// Counts chains, and optionally their grippers.
    fn count(
        &self,
        links: &RangeInclusive<usize>,
        chains_alone: bool,
        listing: &Listing,
        bar: &mut Bar,
    ) -> anyhow::Result<Done> {
        ensure!(
            listing.mobility == 1,
            "--pairs counts chains of one motion; omit --mobility"
        );
        ensure!(
            *links.end() <= MOST_LINKS,
            "chains of pairs are counted up to {MOST_LINKS} links; beyond that there are too many"
        );
        let numbers = links.clone().enumerate();
        let steps = links.clone().count();
        let mut step = |i, n: usize| bar.show_step(&format!("{n} links"), i, steps);
        let menu = Menu {
            kinds: &self.pairs,
            most: self.at_most,
        };
        let mut all = Vec::new();
        for (i, n) in numbers {
            step(i, n);
            all.push((n, pair_census(n, menu, !chains_alone)));
        }
        bar.clear();
        let rows = all.iter().flat_map(|(n, cells)| pair_rows(*n, cells));
        listing.write_rows(&rows.collect_vec(), |_, width| pair_text(&all, width))
    }
}

#[derive(Debug, ClapArgs)]
struct Listing {
    /// Mobility of the chains; all joints have one freedom.
    #[arg(long, value_name = "W", default_value_t = 1)]
    mobility: usize,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextJsonOrCsv,
    #[command(flatten)]
    to: ToFile,
}

impl Listing {
    /// Writes what was found, one row each, or as `text` for a terminal of some width.
    fn write_rows(
        &self,
        all: &[CountRow],
        text: impl Fn(&[CountRow], Option<u16>) -> String,
    ) -> anyhow::Result<Done> {
        self.to.write_all_of(match self.format {
            TextJsonOrCsv::Text => text(all, self.to.width()),
            TextJsonOrCsv::Json => output::json_text(&all)?,
            TextJsonOrCsv::Csv => QueryAnswer::of(all).csv(),
        })
    }
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Count {
    /// Number of links, or a range such as 4..10, its end included.
    #[arg(long, value_name = "N..M", default_value = "4..8", value_parser = parse_links)]
    links: RangeInclusive<usize>,
    /// Only the chains, not the possible roles of their links; with 16 links and more that saves most of the time.
    #[arg(long)]
    chains: bool,
    #[command(flatten)]
    pairs: PairArgs,
    #[command(flatten)]
    listing: Listing,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Chains {
    /// Number of links.
    #[arg(long, value_name = "N", default_value_t = 8)]
    links: usize,
    #[command(flatten)]
    listing: Listing,
}

/// Largest number of links for which grippers are counted; beyond it there are tens of millions.
const MOST_OF_GRIPPERS: usize = 12;
/// Largest number of links for which chains are listed; beyond it the list would not fit into memory.
const MOST_LISTED: usize = 14;

fn parse_links(text: &str) -> Result<RangeInclusive<usize>, String> {
    let all = parse_range(text)
        .map_err(|part| format!("{part:?} is not a number of links; write 8 or 4..10"))?;
    if all.is_empty() || *all.start() < 3 || *all.end() > 18 {
        return Err(
            "chains of 4 to 18 links are counted, with --pairs of 3 to 10; give the smaller number first"
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
        "chains of hinges have at least 4 links; three links need --pairs"
    );
    let mut all = Vec::new();
    for (i, n) in a.links.clone().enumerate() {
        bar.show_step(&format!("{n} links"), i, a.links.clone().count());
        let found = if a.chains {
            count_chains(n, w).map(|chains| hinged_row(n, w, chains, None))
        } else {
            count_hinged(n, w, n <= MOST_OF_GRIPPERS).map(|c| hinged_row(n, w, c.chains, Some(&c)))
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
        output::print_note(&format!(
            "no chain with that number of links has the mobility {w}: 3(n - 1) - {w} must be even\n"
        ));
        return Ok(Done::Nothing);
    }
    a.listing.write_rows(&all, hinged_text)
}

pub(super) fn list(a: &Chains) -> anyhow::Result<Done> {
    ensure!(
        a.links <= MOST_LISTED,
        "chains of up to {MOST_LISTED} links are listed; use `ozols catalog count --links {}` to count these",
        a.links
    );
    let found = list_chains(a.links, a.listing.mobility)?;
    let all: Vec<CountRow> = found.par_iter().map(chain_row).collect();
    a.listing.write_rows(&all, chains_text)
}
