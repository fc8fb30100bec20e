//! `ozols catalog count --pairs`.

use crate::chains::pairs::PairKind;
use crate::chains::pairs::census::pair_census;
use crate::chains::pairs::sharing::Menu;
use crate::chains::pairs::symmetric_census::symmetric_census;
use crate::cli::done::Done;
use crate::cli::terminal::progress::Bar;
use crate::view::catalog::pairs::{pair_rows, pair_text, symmetric_rows, symmetric_text};
use anyhow::ensure;
use clap::Args as ClapArgs;
use itertools::Itertools;
use std::ops::RangeInclusive;

use super::listing::Listing;

#[derive(Debug, ClapArgs)]
pub(super) struct PairArgs {
    /// Chains with other pairs than hinges, too: slide, gear (or rack), slot (pin in a slot, cam, wedge), two-slots (two pins
    /// in two slots between the same links).
    #[arg(long, value_name = "KINDS", value_delimiter = ',', value_parser = kind)]
    pairs: Vec<PairKind>,
    /// Pairs that are not hinges at most; with --up-to-symmetry a left and a right one count once.
    #[arg(long, value_name = "K", default_value_t = 3, requires = "pairs")]
    at_most: usize,
    /// Symmetric grippers alone, by how many pairs they have that are not hinges.
    #[arg(long, requires = "pairs", conflicts_with = "chains")]
    up_to_symmetry: bool,
}

fn kind(word: &str) -> Result<PairKind, String> {
    let others = PairKind::ALL.iter().filter(|k| k.0 != PairKind::Hinge);
    let found = others.clone().find(|k| k.1 == word).map(|k| k.0);
    found.ok_or_else(|| {
        let known = others.map(|k| k.1).join(", ");
        format!("{word:?} is none of {known}; hinges are always there")
    })
}

/// Beyond so many links there are too many chains to be counted one by one.
const MOST_LINKS: usize = 10;

impl PairArgs {
    /// Whether pairs are asked for.
    pub(super) fn are_given(&self) -> bool {
        !self.pairs.is_empty()
    }

    /// Counts chains alone, or their grippers, too.
    pub(super) fn count(
        &self,
        links: &RangeInclusive<usize>,
        chains_alone: bool,
        listing: &Listing,
        bar: &mut Bar,
    ) -> anyhow::Result<Done> {
        listing.is_of_one_motion("--pairs")?;
        ensure!(
            *links.end() <= MOST_LINKS,
            "chains of pairs are counted up to {MOST_LINKS} links: there are too many beyond"
        );
        let numbers = links.clone().enumerate();
        let steps = links.clone().count();
        let mut step = |i, n: usize| bar.step(&format!("{n} links"), i, steps);
        let menu = Menu {
            kinds: &self.pairs,
            most: self.at_most,
        };
        if self.up_to_symmetry {
            let mut all = Vec::new();
            for (i, n) in numbers {
                step(i, n);
                all.extend(symmetric_rows(n, self.at_most, &symmetric_census(n, menu)));
            }
            bar.clear();
            return listing.give(&all, symmetric_text);
        }
        let mut all = Vec::new();
        for (i, n) in numbers {
            step(i, n);
            all.push((n, pair_census(n, menu, !chains_alone)));
        }
        bar.clear();
        let rows = all.iter().flat_map(|(n, cells)| pair_rows(*n, cells));
        listing.give(&rows.collect_vec(), |_, width| pair_text(&all, width))
    }
}
