//! The coordinates in use at a variable as the columns of a matrix, with what its choices add there.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::choice_inclusion::{Grown, one_from_another};
use crate::search::reduce::lifetimes::Lifetime;

/// The columns of a variable: those that close here come first.
#[derive(Debug, Clone)]
pub(in crate::search) struct Columns {
    /// What each choice adds, grown from one another.
    pub(in crate::search) growth: Vec<Grown>,
    /// How many columns there are.
    pub(in crate::search) width: usize,
    /// Where each coordinate that was in use before stands among them; nothing was added at the others yet.
    pub(in crate::search) places: Vec<usize>,
    /// How many of the first ones no later variable reaches.
    pub(in crate::search) closing: usize,
}

impl Columns {
    /// Returns the columns at variable number `at` of the order for some coordinates by number, those that close first, of which
    /// `closing` do. `added` are the vectors of each choice in all coordinates.
    pub(in crate::search) fn new(
        field: Field,
        lifetimes: &[Lifetime],
        at: usize,
        coordinates: &[usize],
        closing: usize,
        added: &[Vec<Vec<Residue>>],
    ) -> Columns {
        let mut before: Vec<usize> = coordinates.to_vec();
        before.retain(|&c| lifetimes[c].is_live_before(at));
        before.sort_unstable();
        let place = |c: &usize| coordinates.iter().position(|x| x == c);
        let within = |vectors: &Vec<Vec<Residue>>| -> Vec<Vec<Residue>> {
            let row = |v: &Vec<Residue>| coordinates.iter().map(|&c| v[c]).collect();
            vectors.iter().map(row).collect()
        };
        let spans: Vec<Vec<Vec<Residue>>> = added.iter().map(within).collect();
        let spans: Vec<&[Vec<Residue>]> = spans.iter().map(Vec::as_slice).collect();
        Columns {
            growth: one_from_another(field, &spans),
            width: coordinates.len(),
            places: before.iter().filter_map(place).collect(),
            closing,
        }
    }

    /// Returns how many dimensions each choice adds at most, by number.
    pub(in crate::search) fn dimensions(&self) -> Vec<usize> {
        let mut out = vec![0; self.growth.len()];
        for g in &self.growth {
            out[g.choice] = g.from.map_or(0, |from| out[from]) + g.more.len();
        }
        out
    }
}

/// The columns of contours and of kept links at a variable, where no motion that goes wrong is forgotten: all that kept links do.
#[derive(Debug, Clone)]
pub(in crate::search) struct Adding {
    /// Index of the variable in the space.
    pub(in crate::search) variable: usize,
    /// The coordinates of contours in use, by their numbers; all those of kept links come after these.
    pub(in crate::search) contours: Vec<usize>,
    /// The columns; those that close are of contours.
    pub(in crate::search) columns: Columns,
}
