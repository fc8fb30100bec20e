//! Biconnected blocks of a mechanism: parts that share at most one link; the search takes them one after another.
//!
//! Contours that no chain of common joints ties together make nothing redundant in each other, so a diagram forgets one block before
//! it begins the next: nodes add up where they would multiply. Blocks that say nothing about the motion that is asked for come first;
//! of the others, what hangs side by side on the frame is still taken one after another. A joint that is in no contour is a block by
//! itself.
//!
//! # Sources
//! Blocks and cut vertices: Harary, "Graph Theory" (1969), chapter 3.

use crate::closure::contour::Contour;
use crate::closure::tree::connected_sets;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::search::question::space::Space;
use std::collections::{BTreeMap, BTreeSet};

/// Variables that a question takes together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::search) struct Block {
    /// The variables, ascending.
    pub(in crate::search) variables: Vec<usize>,
    /// Whether it says nothing about the motion of kept links.
    pub(in crate::search) apart: bool,
}

/// Returns the blocks of some variables. Those on the path between `pinned` links come last. `contours` is a basis of the
/// mechanism's loops.
///
/// # Complexity
/// O(b · n) for b blocks of n joints in all.
pub(in crate::search) fn find_blocks(
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
        let drive = |j| mechanism.kept_drive(j).map(|d| mechanism.drive_link(d));
        let touched = joints.flat_map(|j| mechanism.joints[j].links.into_iter().chain(drive(j)));
        touched.collect()
    };
    let mut left: Vec<(Vec<usize>, BTreeSet<LinkId>)> =
        connected_sets(contours.chain(couplings).chain(each))
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
    let mut out = at_one_link(&mut left, holds);
    let mut at: BTreeMap<LinkId, Vec<usize>> = BTreeMap::new();
    for (of, links) in &left {
        let shared = links.iter().filter(|l| **l != mechanism.frame_link());
        shared.for_each(|&l| at.entry(l).or_default().push(of[0]));
    }
    let rest = left.into_iter().map(|(of, _)| of);
    let beside = connected_sets(rest.chain(at.into_values()));
    out.extend(beside.into_iter().map(|variables| Block {
        variables,
        apart: false,
    }));
    out
}

/// Takes out the blocks that meet all the rest in one link, or in none: they say nothing about the motion of the rest. `left` are
/// variables with their links, and `holds` says how many of them, and of what is asked for, hold a link.
fn at_one_link(
    left: &mut Vec<(Vec<usize>, BTreeSet<LinkId>)>,
    mut holds: BTreeMap<LinkId, usize>,
) -> Vec<Block> {
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
                    apart: true,
                });
            }
            shared > 1
        });
        if left.len() == before {
            return out;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closure::contour::contour_basis;
    use crate::model::drawn::{Drawn, draw_mechanism, four_bar};
    use crate::model::mechanism::StateId;
    use crate::rank::exact::field::exact_field;
    use crate::search::question::cost::CostTable;

    /// The variables of each block and whether it is apart, where the motion of the frame and of these links is asked for.
    fn found(joints: &[Drawn], pinned: &[usize]) -> Vec<(Vec<usize>, bool)> {
        let m = draw_mechanism(joints, &[]);
        let exact = exact_field(&m, 0).unwrap();
        let costs = CostTable::new(&m.search.costs);
        let space = Space::new(&exact, &m, None, false, &costs).unwrap();
        let all: Vec<usize> = (0..joints.len()).collect();
        let pinned: Vec<LinkId> = pinned.iter().map(|&l| LinkId::new(l)).collect();
        let contours = contour_basis(&m, StateId::FREE);
        let found = find_blocks(&m, &space, &all, &pinned, &contours);
        found.into_iter().map(|b| (b.variables, b.apart)).collect()
    }

    /// Two four-bars in a row share a link: each is a block, and has that link for itself.
    #[test]
    fn four_bars_in_a_row_are_blocks_of_their_own() {
        let joints = [four_bar(0, 1, 0.0), four_bar(2, 4, 40.0)].concat();
        let mut found = found(&joints, &[]);
        found.sort();
        let of: Vec<&Vec<usize>> = found.iter().map(|b| &b.0).collect();
        assert_eq!(of, [&vec![0, 1, 2, 3], &vec![4, 5, 6, 7]]);
        assert!(found.iter().all(|b| b.1));
    }

    /// Side by side on the frame, both on the way to a link that is asked for, they share the frame alone, and one is taken after
    /// the other; in a row they hang together.
    #[test]
    fn what_hangs_side_by_side_on_the_frame_is_taken_one_after_another() {
        let beside = [four_bar(0, 1, 0.0), four_bar(0, 4, 40.0)].concat();
        let each = [(vec![0, 1, 2, 3], false), (vec![4, 5, 6, 7], false)];
        assert_eq!(found(&beside, &[0, 2, 5]), each);
        let in_a_row = [four_bar(0, 1, 0.0), four_bar(2, 4, 40.0)].concat();
        assert_eq!(found(&in_a_row, &[0, 5]), [((0..8).collect(), false)]);
    }
}
