//! Blocks of a mechanism: parts that meet in a link at most, and that a question takes one after another.
//!
//! Contours that no chain of common joints ties together make nothing redundant in each other, so each block has its own
//! copy of the links it shares, and a diagram forgets one before it begins the next: nodes add up where they would
//! multiply. Only blocks on the way between links whose motion is asked for keep them; there, what hangs side by side on
//! the frame is still taken one after another. A joint that is in no contour is a block by itself.
//!
//! # Sources
//! Blocks and cut vertices: Harary, "Graph Theory" (1969), chapter 3.

use crate::closure::contour::Contour;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::search::space::Space;
use petgraph::unionfind::UnionFind;
use std::collections::{BTreeMap, BTreeSet};

/// Variables that a question takes together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Block {
    /// The variables, ascending.
    pub(super) variables: Vec<usize>,
    /// The copy of the links that it joins: 0 is the mechanism's own, which blocks share.
    pub(super) lane: usize,
}

/// The blocks of some variables, those on the way between `pinned` links last. `contours` are a basis of the mechanism's.
///
/// # Complexity
/// O(b · n) for b blocks of n joints in all.
pub(super) fn blocks(
    mechanism: &Mechanism,
    space: &Space,
    variables: &[usize],
    pinned: &[LinkId],
    contours: &[Contour],
) -> Vec<Block> {
    let joints = |v: usize| space.variables[v].joints.iter().copied();
    let variable: BTreeMap<JointId, usize> = variables
        .iter()
        .flat_map(|&v| joints(v).map(move |j| (j, v)))
        .collect();
    let mut sets = UnionFind::new(space.variables.len());
    let contours = contours
        .iter()
        .map(|c| c.joints.iter().map(|(j, _)| *j).collect());
    let couplings = mechanism
        .couplings
        .iter()
        .map(|c| c.ends.iter().map(|e| e.joint).collect());
    for tied in contours.chain(couplings) {
        let tied: Vec<JointId> = tied;
        let of: Vec<usize> = tied
            .iter()
            .filter_map(|j| variable.get(j).copied())
            .collect();
        of.windows(2).for_each(|w| {
            sets.union(w[0], w[1]);
        });
    }
    let links = |of: &[usize]| -> BTreeSet<LinkId> {
        let joints = of.iter().flat_map(|&v| joints(v));
        joints.flat_map(|j| mechanism.joints[j].links).collect()
    };
    let mut left: Vec<(Vec<usize>, BTreeSet<LinkId>)> = classes(&sets, variables)
        .map(|of| {
            let links = links(&of);
            (of, links)
        })
        .collect();
    let mut holds: BTreeMap<LinkId, usize> = pinned.iter().map(|&l| (l, 1)).collect();
    for l in left.iter().flat_map(|(_, links)| links) {
        *holds.entry(*l).or_insert(0) += 1;
    }
    // What meets all the rest in one link, or in none, says nothing about the motion of the rest.
    let mut out: Vec<Block> = Vec::new();
    loop {
        let before = left.len();
        left.retain(|(of, links)| {
            let shared = links.iter().filter(|l| holds[l] > 1).count();
            if shared <= 1 {
                links
                    .iter()
                    .for_each(|l| *holds.entry(*l).or_insert(1) -= 1);
                out.push(Block {
                    variables: of.clone(),
                    lane: out.len() + 1,
                });
            }
            shared > 1
        });
        if left.len() == before {
            break;
        }
    }
    let mut at: BTreeMap<LinkId, usize> = BTreeMap::new();
    for (of, links) in &left {
        for &l in links.iter().filter(|l| **l != mechanism.frame()) {
            sets.union(*at.entry(l).or_insert(of[0]), of[0]);
        }
    }
    let rest: Vec<usize> = left.into_iter().flat_map(|(of, _)| of).collect();
    out.extend(classes(&sets, &rest).map(|variables| Block { variables, lane: 0 }));
    out
}

/// The sets of some variables.
fn classes(sets: &UnionFind<usize>, variables: &[usize]) -> impl Iterator<Item = Vec<usize>> {
    let mut out: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &v in variables {
        out.entry(sets.find(v)).or_default().push(v);
    }
    out.into_values()
}
