//! Biconnected blocks of a mechanism: parts that share at most one link; the search takes them one after another.
//!
//! Contours that no chain of common joints ties together make nothing redundant in each other, so each block has its own
//! copy of the links it shares, and a diagram forgets one before it begins the next: nodes add up where they would
//! multiply. Only blocks on the way between links whose motion is asked for keep them; there, what hangs side by side on
//! the frame is still taken one after another. A joint that is in no contour is a block by itself.
//!
//! # Sources
//! Blocks and cut vertices: Harary, "Graph Theory" (1969), chapter 3.

use crate::closure::connected::tied;
use crate::closure::contour::Contour;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::search::question::space::Space;
use std::collections::{BTreeMap, BTreeSet};

/// Variables that a question takes together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::search) struct Block {
    /// The variables, ascending.
    pub(in crate::search) variables: Vec<usize>,
    /// The copy of the links that it joins: 0 is the mechanism's own, which blocks share.
    pub(in crate::search) lane: usize,
}

/// The blocks of some variables, those on the way between `pinned` links last. `contours` are a basis of the mechanism's.
///
/// # Complexity
/// O(b · n) for b blocks of n joints in all.
pub(in crate::search) fn blocks(
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
    let of = |joints: &mut dyn Iterator<Item = JointId>| -> Vec<usize> {
        joints.filter_map(|j| variable.get(&j).copied()).collect()
    };
    let contours = contours
        .iter()
        .map(|c| of(&mut c.joints.iter().map(|(j, _)| *j)));
    let couplings = mechanism
        .couplings
        .iter()
        .map(|c| of(&mut c.ends.iter().map(|e| e.joint)));
    let each = variables.iter().map(|&v| vec![v]);
    let links = |of: &[usize]| -> BTreeSet<LinkId> {
        let joints = of.iter().flat_map(|&v| joints(v));
        joints.flat_map(|j| mechanism.joints[j].links).collect()
    };
    let mut left: Vec<(Vec<usize>, BTreeSet<LinkId>)> = tied(contours.chain(couplings).chain(each))
        .into_iter()
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
    let mut at: BTreeMap<LinkId, Vec<usize>> = BTreeMap::new();
    for (of, links) in &left {
        let shared = links.iter().filter(|l| **l != mechanism.frame());
        shared.for_each(|&l| at.entry(l).or_default().push(of[0]));
    }
    let rest = left.into_iter().map(|(of, _)| of);
    let beside = tied(rest.chain(at.into_values()));
    out.extend(
        beside
            .into_iter()
            .map(|variables| Block { variables, lane: 0 }),
    );
    out
}
