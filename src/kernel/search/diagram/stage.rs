//! A variable of the diagram: the coordinates in use as columns of a matrix, and what its choices add there, lane by lane.
//!
//! In each lane a node has two subspaces of the space dual to the self-stresses of the original joints. `all` is what the choices so
//! far add in the contours that are still open. `harmless` is the part of it that moves no kept link which is closed already, in the
//! open coordinates of contours and kept links. A variable extends both by what a choice adds and drops the coordinates that close.
//! A motion goes wrong if it closes every contour and moves a kept link. There is one exactly if `all` gains fewer dimensions
//! than `harmless`: then two motions that differ only in what kept links do are both possible, and so is their difference.
//!
//! Most options contain others: a universal joint contains the hinge, a ball the universal joint. So the rows of a larger choice are
//! those of a smaller one and a vector or two.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::redundancy_so_far::{Limits, Role};
use crate::search::reduce::lifetimes::Lifetime;

/// A choice, written as an earlier one and some vectors more.
#[derive(Debug, Clone)]
pub(in crate::search) struct Grown {
    /// The choice.
    pub(in crate::search) choice: usize,
    /// The choice that it contains, which comes before it in the list; `None` for the bare node.
    pub(in crate::search) from: Option<usize>,
    /// The vectors that it adds.
    pub(in crate::search) more: Vec<Vec<Residue>>,
}

/// Spans, smaller ones first, each with the largest one before it that it contains, and its own vectors that this has not.
pub(in crate::search) fn one_from_another(field: Field, spans: &[&[Vec<Residue>]]) -> Vec<Grown> {
    let mut order: Vec<usize> = (0..spans.len()).collect();
    order.sort_by_key(|&c| spans[c].len());
    let mut out: Vec<Grown> = Vec::with_capacity(spans.len());
    let wholes = spans.iter().map(|span| Echelon::from_vectors(field, *span));
    let wholes: Vec<Echelon> = wholes.collect();
    for (i, &choice) in order.iter().enumerate() {
        let whole = &wholes[choice];
        let contained = |c: &&usize| spans[**c].iter().all(|t| whole.contains(t));
        let from = order[..i].iter().rev().find(contained).copied();
        let mut known = from.map_or_else(|| Echelon::new(field), |from| wholes[from].clone());
        let new = spans[choice].iter().filter(|t| known.insert(t));
        out.push(Grown {
            choice,
            from,
            more: new.cloned().collect(),
        });
    }
    out
}

/// The columns of a variable: those that close here come first.
#[derive(Debug, Clone)]
pub(in crate::search) struct Columns {
    /// The vectors that each choice adds, grown from one another.
    pub(in crate::search) growth: Vec<Grown>,
    /// How many columns there are.
    pub(in crate::search) width: usize,
    /// The columns of the coordinates that were in use before, in their order. The others are zero so far.
    pub(in crate::search) places: Vec<usize>,
    /// The number of first columns that no later variable reaches.
    pub(in crate::search) closing: usize,
    /// The number of first columns that a motion may start in. One that starts behind them goes wrong.
    pub(in crate::search) contours: usize,
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
            contours: coordinates.len(),
        }
    }

    /// Returns the maximum number of dimensions that each choice adds, by number.
    pub(in crate::search) fn added_dimensions(&self) -> Vec<usize> {
        let mut out = vec![0; self.growth.len()];
        for g in &self.growth {
            out[g.choice] = g.from.map_or(0, |from| out[from]) + g.more.len();
        }
        out
    }
}

/// A variable of a lane.
#[derive(Debug, Clone)]
pub(in crate::search) struct LaneStage {
    pub(in crate::search) role: Role,
    /// The contours in use.
    pub(in crate::search) all: Columns,
    /// Contours and kept links in use, where motions are kept.
    pub(in crate::search) harmless: Option<Columns>,
    /// Whether the lane applies to each choice; empty if it applies to all.
    pub(in crate::search) applies: Vec<bool>,
}

/// A variable of the diagram.
#[derive(Debug, Clone)]
pub(in crate::search) struct Stage<'a> {
    pub(in crate::search) field: Field,
    /// Index of the variable in the space.
    pub(in crate::search) variable: usize,
    pub(in crate::search) choices: usize,
    /// The free state's first.
    pub(in crate::search) lanes: Vec<LaneStage>,
    /// The roles of the lanes of a searched state, at its last variable.
    pub(in crate::search) ending: Option<Vec<Role>>,
    pub(in crate::search) limits: &'a Limits,
}

impl Stage<'_> {
    /// Returns the lane and the columns of each kind of subspace that a node has: lane by lane `all`, then `harmless`.
    pub(in crate::search) fn kinds(&self) -> impl Iterator<Item = (usize, &Columns)> {
        self.lanes.iter().enumerate().flat_map(|(number, lane)| {
            let both = std::iter::once(&lane.all).chain(&lane.harmless);
            both.map(move |columns| (number, columns))
        })
    }

    /// Estimates the field operations for a child of a node of `bytes` bytes.
    pub(in crate::search) fn child_effort(&self, bytes: usize) -> usize {
        let width: usize = self.kinds().map(|(_, columns)| columns.width).sum();
        bytes / size_of::<Residue>() * width.max(1)
    }
}
