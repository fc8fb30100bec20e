//! In which order to choose: contours should close early and few links stay live.
//!
//! Contours are taken whole, each by the shortest way through joints not chosen yet that begins and ends at live links (an
//! [`ear`](ears)). A beam search over such ways keeps those whose layers are least, measured by trials. What is alike is taken in the
//! canonical order, so that the file's order of tables makes no difference. A bad order costs time, never correctness.
//!
//! # Sources
//! The choice of orders by the sizes of real diagrams: Rudell, "Dynamic variable ordering for ordered binary decision diagrams",
//! ICCAD 1993.

pub(in crate::search) mod canonical;
mod ears;
pub(in crate::search) mod trial;

use crate::geom::exact::ExactField;
use crate::model::mechanism::{LinkId, Mechanism};
use crate::search::order::canonical::canonical;
use crate::search::order::ears::Joined;
use crate::search::order::trial::{Trial, Trials};
use crate::search::question::space::Space;
use crate::search::reduce::biconnected::Block;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Orders kept after each contour.
const BEAM: usize = 2;

/// An order of the variables of some blocks, block by block, whose diagram, with two choices a variable, is among the smallest
/// found; of those that join the mechanism's own links, the frame stays to the end, and they come last.
///
/// # Complexity
/// O(contours · BEAM · EARS) trials of an ear.
#[must_use]
pub(super) fn variable_order(
    exact: &ExactField,
    mechanism: &Mechanism,
    space: &Space,
    blocks: &[Block],
    max_redundant: u32,
) -> Vec<usize> {
    let all: Vec<usize> = blocks.iter().flat_map(|b| b.variables.clone()).collect();
    let place = canonical(mechanism, space, &all);
    let mut block_of = BTreeMap::new();
    for (b, block) in blocks.iter().enumerate() {
        block_of.extend(block.variables.iter().map(|&v| (v, b)));
    }
    let mut sorted: Vec<Vec<usize>> = vec![Vec::new(); blocks.len()];
    let mut met = Vec::new();
    for v in place {
        let b = block_of[&v];
        if sorted[b].is_empty() {
            met.push(b);
        }
        sorted[b].push(v);
    }
    met.sort_by_key(|&b| blocks[b].lane == 0);
    let of = |b: usize| {
        let pinned = match blocks[b].lane {
            0 => &[mechanism.frame()][..],
            _ => &[],
        };
        order_of_block(exact, mechanism, space, &sorted[b], pinned, max_redundant)
    };
    met.into_iter().flat_map(of).collect()
}

/// The order of one block, whose variables are given in the canonical order.
fn order_of_block(
    exact: &ExactField,
    mechanism: &Mechanism,
    space: &Space,
    variables: &[usize],
    pinned: &[LinkId],
    max_redundant: u32,
) -> Vec<usize> {
    if let [_] = variables {
        return variables.to_vec();
    }
    let (mut trials, start) =
        Trials::new(exact, mechanism, space, variables, pinned, max_redundant);
    let joined = Joined::new(&trials, variables);
    let mut beam = vec![start];
    while beam.iter().any(|t| t.order.len() < variables.len()) {
        let mut next: BTreeMap<Vec<u64>, Trial> = BTreeMap::new();
        for trial in beam {
            for ear in joined.ears(&trial) {
                let mut grown = trial.clone();
                ear.iter().for_each(|&v| trials.add(&mut grown, v));
                match next.entry(joined.taken(&grown)) {
                    Entry::Vacant(vacant) => {
                        vacant.insert(grown);
                    }
                    Entry::Occupied(mut known) if known.get().work > grown.work => {
                        known.insert(grown);
                    }
                    Entry::Occupied(_) => {}
                }
            }
        }
        let places = |t: &Trial| -> Vec<usize> {
            let each = t.order.iter();
            each.map(|&v| joined.place(v)).collect()
        };
        beam = next.into_values().collect();
        beam.sort_by_cached_key(|t| (t.work, places(t)));
        beam.truncate(BEAM);
    }
    let best = beam.into_iter().next();
    best.map_or(variables.to_vec(), |t| t.order)
}
