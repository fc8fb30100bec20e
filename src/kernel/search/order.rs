//! In which order to choose: contours should close early and few links stay live.
//!
//! Contours are taken whole, each by the shortest way through joints not chosen yet that begins and ends at live links (an
//! ear). A beam search over such ways keeps those whose layers are least, measured by trials. What is alike is taken in the
//! canonical order, so that the file's order of tables makes no difference. A bad order costs time, never correctness.
//!
//! # Sources
//! Ears: Whitney, "Non-separable and planar graphs", Trans. AMS 34 (1932). The choice of orders by the sizes of real
//! diagrams: Rudell, "Dynamic variable ordering for ordered binary decision diagrams", ICCAD 1993.

pub(in crate::search) mod canonical;
pub(in crate::search) mod trial;

use crate::geom::exact::ExactField;
use crate::model::mechanism::{LinkId, Mechanism};
use crate::search::order::canonical::canonical;
use crate::search::order::trial::{Trial, Trials};
use crate::search::question::space::Space;
use crate::search::reduce::biconnected::Block;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Orders kept after each contour.
const BEAM: usize = 2;
/// Ways tried for the first contour, from each of its joints and both ways round.
const STARTS: usize = 16;
/// Ways tried for each further one.
const EARS: usize = 6;

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
    let mut beam = vec![start];
    while beam.iter().any(|t| t.order.len() < variables.len()) {
        let mut next: BTreeMap<BTreeSet<usize>, Trial> = BTreeMap::new();
        for trial in beam {
            for ear in ears(&trials, variables, &trial) {
                let mut grown = trial.clone();
                ear.iter().for_each(|&v| trials.add(&mut grown, v));
                let set: BTreeSet<usize> = grown.order.iter().copied().collect();
                match next.get(&set) {
                    Some(known) if known.work <= grown.work => {}
                    _ => {
                        next.insert(set, grown);
                    }
                }
            }
        }
        let place = |t: &Trial| -> Vec<Option<usize>> {
            let of = |v: &usize| variables.iter().position(|x| x == v);
            t.order.iter().map(of).collect()
        };
        beam = next.into_values().collect();
        beam.sort_by_cached_key(|t| (t.work, place(t)));
        beam.truncate(BEAM);
    }
    let best = beam.into_iter().next();
    best.map_or(variables.to_vec(), |t| t.order)
}

/// Ways to go on: ears, the shortest first, or where no contour is left the next joint; nothing more for a whole order.
fn ears(trials: &Trials, variables: &[usize], trial: &Trial) -> Vec<Vec<usize>> {
    let left: Vec<usize> = variables
        .iter()
        .copied()
        .filter(|v| !trial.order.contains(v))
        .collect();
    if left.is_empty() {
        return vec![Vec::new()];
    }
    let edges: Vec<(usize, [LinkId; 2])> = left
        .iter()
        .flat_map(|&v| trials.joined(v).map(move |links| (v, links)))
        .collect();
    let live = |l: LinkId| trial.planner.is_live(l);
    let begun = edges
        .iter()
        .any(|(_, links)| links.iter().any(|&l| live(l)));
    let mut out: Vec<Vec<usize>> = Vec::new();
    for (e, &(_, [a, b])) in edges.iter().enumerate() {
        for (from, to) in [(a, b), (b, a)] {
            if begun && !live(from) {
                continue;
            }
            let ends = |l: LinkId| if begun { live(l) } else { l == from };
            if let Some(ear) = ear(&edges, e, to, ends)
                && !out.contains(&ear)
            {
                out.push(ear);
            }
        }
    }
    // The sort is stable: ways of equal length stay in the canonical order.
    out.sort_by_key(Vec::len);
    out.truncate(if begun { EARS } else { STARTS });
    if out.is_empty() {
        let next = edges
            .iter()
            .find(|(_, links)| links.iter().any(|&l| live(l)));
        out.extend(next.or(edges.first()).map(|(v, _)| vec![*v]));
    }
    out
}

/// The shortest way over an edge and on from `to` until `ends` says so, as variables.
fn ear(
    edges: &[(usize, [LinkId; 2])],
    first: usize,
    to: LinkId,
    ends: impl Fn(LinkId) -> bool,
) -> Option<Vec<usize>> {
    let mut back: BTreeMap<LinkId, usize> = BTreeMap::from([(to, first)]);
    let mut queue = VecDeque::from([to]);
    while let Some(at) = queue.pop_front() {
        if ends(at) {
            let (mut way, mut link) = (Vec::new(), at);
            loop {
                let e = back[&link];
                way.push(edges[e].0);
                if e == first {
                    break;
                }
                let [a, b] = edges[e].1;
                link = if a == link { b } else { a };
            }
            way.reverse();
            let mut seen = BTreeSet::new();
            way.retain(|v| seen.insert(*v));
            return Some(way);
        }
        for (e, (_, [a, b])) in edges.iter().enumerate() {
            let next = match at {
                x if x == *a => *b,
                x if x == *b => *a,
                _ => continue,
            };
            if e != first && !back.contains_key(&next) {
                back.insert(next, e);
                queue.push_back(next);
            }
        }
    }
    None
}
