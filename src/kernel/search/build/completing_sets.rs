//! Sets of the nodes of one half that complete those of the other.

use crate::search::diagram::DEAD;
use crate::search::diagram::node_sets::Set;
use hashbrown::HashMap;
use rayon::prelude::*;

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
    cancelled: &(dyn Fn() -> bool + Sync),
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
