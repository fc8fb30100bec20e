//! Sets of the nodes of a layer, and of the nodes of one half of a diagram that complete those of the other.

use crate::search::diagram::layer::{DEAD, ShouldCancel};
use hashbrown::HashMap;
use rayon::prelude::*;

/// A set of nodes of a layer.
pub(in crate::search) type Set = Box<[u64]>;

/// Returns true if a node is in a set.
pub(in crate::search) fn contains_node(set: &Set, node: usize) -> bool {
    set[node / 64] >> (node % 64) & 1 == 1
}

/// Returns an empty set of nodes.
pub(in crate::search) fn empty_set(nodes: usize) -> Set {
    vec![0; nodes.div_ceil(64)].into_boxed_slice()
}

/// Puts a node into a set.
pub(in crate::search) fn add_node(set: &mut Set, node: usize) {
    set[node / 64] |= 1 << (node % 64);
}

/// Returns the set of the nodes that pass a test.
pub(in crate::search) fn collect_set(nodes: usize, mut is_in: impl FnMut(usize) -> bool) -> Set {
    let mut out = empty_set(nodes);
    (0..nodes)
        .filter(|&n| is_in(n))
        .for_each(|n| add_node(&mut out, n));
    out
}

/// Returns the nodes of a set in ascending order.
pub(in crate::search) fn nodes_in(set: &[u64]) -> impl Iterator<Item = usize> {
    set.iter().enumerate().flat_map(|(place, &word)| {
        let more = |bits: &u64| Some(bits & (bits - 1)).filter(|b| *b != 0);
        let left = std::iter::successors(Some(word).filter(|b| *b != 0), more);
        left.map(move |bits| 64 * place + bits.trailing_zeros() as usize)
    })
}

/// Different sets, numbered.
#[derive(Default)]
pub(in crate::search) struct Numbered {
    known: HashMap<Set, u32>,
    pub(in crate::search) all: Vec<Set>,
}

impl Numbered {
    /// Returns the number of a set; [`DEAD`] of the empty one.
    pub(in crate::search) fn number_of(&mut self, set: Set) -> u32 {
        if set.iter().all(|&w| w == 0) {
            return DEAD;
        }
        *self.known.entry(set).or_insert_with_key(|set| {
            self.all.push(set.clone());
            u32::try_from(self.all.len() - 1).expect("fewer than nodes")
        })
    }
}

/// Number of nodes between two checks for cancellation.
const BATCH: usize = 512;

/// Returns for each node the set of nodes of the other half that complete it; `None` if cancelled.
pub(in crate::search) fn completing_sets(
    nodes: usize,
    completing: impl Fn(usize) -> Set + Sync,
    cancelled: ShouldCancel<'_>,
) -> Option<Vec<Set>> {
    let mut sets = Vec::with_capacity(nodes);
    for start in (0..nodes).step_by(BATCH) {
        if cancelled() {
            return None;
        }
        let batch = start..(start + BATCH).min(nodes);
        sets.par_extend(batch.into_par_iter().map(&completing));
    }
    Some(sets)
}
