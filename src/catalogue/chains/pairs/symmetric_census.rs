//! Which grippers move symmetrically, and how many there are by how many choices of a pair that is no hinge they take: a left and
//! a right slide are one.

use crate::chains::canonical::Weighted;
use crate::chains::pairs::chain::MOST_LINKS;
use crate::chains::pairs::halves::{SymmetricGraph, symmetric_graphs};
use crate::chains::pairs::motion::{Image, Swap, Velocity, symmetric_motions};
use crate::chains::pairs::roles::{PairRoles, PairSubject};
use crate::chains::pairs::sharing::{Menu, Sharing};
use crate::chains::pairs::structure::PairStructure;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// A way in which grippers are counted apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymmetricKind {
    /// Half a turn; otherwise a mirror image.
    pub half_turn: bool,
    /// A jaw is a link of the input joint; otherwise the jaws are apart from it.
    pub driven_jaw: bool,
    /// Orbits of pairs that are not hinges.
    pub orbits: usize,
}

/// A gripper that moves symmetrically.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SymmetricGripper {
    /// Its structure, in canonical numbering.
    pub structure: PairStructure,
    /// How it counts.
    pub kind: SymmetricKind,
}

/// Every essential gripper that moves symmetrically with the input joint carried to itself, as a mirror image and by half a turn
/// apart; with the fewest orbits of pairs that are not hinges that it can be seen to have.
///
/// # Complexity
/// As of [`crate::chains::pairs::census::visit_pair_chains`], over the halves.
#[must_use]
pub fn symmetric_grippers(links: usize, menu: Menu<'_>) -> Vec<SymmetricGripper> {
    let least = Mutex::new(BTreeMap::<(bool, bool, Weighted), usize>::new());
    if !(3..=MOST_LINKS).contains(&links) {
        return Vec::new();
    }
    let joints = menu.most_joints(links, 2 * menu.most);
    symmetric_graphs(links, joints)
        .par_iter()
        .for_each(|graph| {
            let sharing = Sharing::new(&graph.graph, &graph.automorphisms, &graph.swap);
            sharing.share(menu, &mut |chain, automorphisms| {
                let subject = PairSubject::new(&chain, &automorphisms);
                let orbits = subject.other_pairs_up_to(&graph.swap);
                let found = grippers(&subject, graph).into_iter();
                let found = found.map(|(half_turn, roles)| {
                    let driven_jaw = roles.has_driven_jaw();
                    let chain = chain.clone();
                    let key = PairStructure { chain, roles }.key();
                    (half_turn, driven_jaw, key)
                });
                // Numbered before others have to wait.
                let found: Vec<_> = found.collect();
                let mut least = least.lock().unwrap_or_else(PoisonError::into_inner);
                for key in found {
                    let known = least.entry(key).or_insert(orbits);
                    *known = orbits.min(*known);
                }
            });
        });
    let least = least.into_inner().unwrap_or_else(PoisonError::into_inner);
    let gripper = |((half_turn, driven_jaw, key), orbits)| SymmetricGripper {
        structure: PairStructure::of_key(&key),
        kind: SymmetricKind {
            half_turn,
            driven_jaw,
            orbits,
        },
    };
    least.into_iter().map(gripper).collect()
}

/// Counts of these.
///
/// # Complexity
/// As [`symmetric_grippers`].
#[must_use]
pub fn symmetric_census(links: usize, menu: Menu<'_>) -> BTreeMap<SymmetricKind, u64> {
    let mut out = BTreeMap::new();
    for gripper in symmetric_grippers(links, menu) {
        *out.entry(gripper.kind).or_default() += 1;
    }
    out
}

/// The grippers of a chain that move so that an involution carries them to themselves, and how.
fn grippers(subject: &PairSubject<'_>, graph: &SymmetricGraph) -> Vec<(bool, PairRoles)> {
    let swap = &graph.swap[..];
    let Some(fixed) = swap.iter().enumerate().position(|(l, &to)| l == to) else {
        return Vec::new();
    };
    let mut out = Vec::new();
    for image in [Image::Mirror, Image::HalfTurn] {
        let swap = Swap { links: swap, image };
        let motions = symmetric_motions(subject.chain, swap, fixed);
        if motions.is_empty() {
            continue;
        }
        for roles in subject.symmetric_roles(swap.links) {
            let moves = |m: &Vec<Velocity>| roles.moves_in(m);
            if motions.iter().any(moves) && subject.is_essential(&roles) {
                out.push((image == Image::HalfTurn, roles));
            }
        }
    }
    out
}
