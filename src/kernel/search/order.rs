//! The order of variables: contours should close early, and few coordinates stay open.
//!
//! Contours are taken whole, each by the shortest way through joints not chosen yet that begins and ends at links reached already (an
//! [`ear`](ears)). A beam search keeps the ways behind which the fewest coordinates are open ([`widths`]). Equal ways are taken in the
//! canonical order, so that the file's order of tables makes no difference. A bad order costs time, never correctness.

pub(in crate::search) mod canonical;
mod ears;
mod widths;

use crate::search::order::canonical::canonical_order;
use crate::search::order::ears::Joined;
use crate::search::order::widths::{Trial, Widths};
use crate::search::question::Question;
use crate::search::reduce::biconnected::Block;
use crate::search::reduce::self_stress_space::ClosingRows;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Orders kept after each contour.
const BEAM: usize = 2;

/// Returns an order of the variables of some blocks by the closure equations in `rows`. Blocks that have a say in the motion of kept
/// links come last, and variables in `later` after all. The order of each block is among the narrowest found.
///
/// # Complexity
/// O(contours · BEAM · EARS) ears tried.
#[must_use]
pub(super) fn variable_order(
    question: &Question,
    blocks: &[Block],
    rows: &ClosingRows<'_>,
    later: &[usize],
) -> Vec<usize> {
    let all: Vec<usize> = blocks.iter().flat_map(|b| b.variables.clone()).collect();
    let place = canonical_order(&question.mechanism, &question.space, &all);
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
    met.sort_by_key(|&b| !blocks[b].apart);
    let (field, space) = (question.exact.field(), &question.space);
    let of = |b: usize| match &sorted[b][..] {
        [one] => vec![*one],
        variables => {
            let widths = Widths::new(field, space, rows, variables, later);
            order_of_block(&Joined::new(question, variables), &widths, variables)
        }
    };
    met.into_iter().flat_map(of).collect()
}

/// Returns the order of one block, whose variables are given in the canonical order.
fn order_of_block(joined: &Joined, widths: &Widths, variables: &[usize]) -> Vec<usize> {
    let mut beam = vec![widths.empty_trial()];
    while beam.iter().any(|t| t.order.len() < variables.len()) {
        let mut next: BTreeMap<Vec<u64>, Trial> = BTreeMap::new();
        for trial in beam {
            for ear in joined.find_ears(&trial) {
                let mut grown = trial.clone();
                ear.iter().for_each(|&v| widths.add_variable(&mut grown, v));
                match next.entry(joined.taken_bits(&grown)) {
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
            each.map(|&v| joined.canonical_place(v)).collect()
        };
        beam = next.into_values().collect();
        beam.sort_by_cached_key(|t| (t.work, places(t)));
        beam.truncate(BEAM);
    }
    let best = beam.into_iter().next();
    best.map_or(variables.to_vec(), |t| t.order)
}
