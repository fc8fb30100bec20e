//! The grippers that move symmetrically, each with its number of choices of pairs other than hinges: a left and a right slide are
//! one choice.
//!
//! Symmetric graphs are built by halves, each with its image. A link is its own image, or changes places with another. An orbit
//! of joints is one that is its own image, or two that change places. Graphs grow by one orbit at a time, in every way that
//! differs by more than numbering.

use crate::chains::Symmetry;
use crate::chains::canonical::{Weighted, number_graph};
use crate::chains::chain::{MOST_LINKS, order_links};
use crate::chains::enumerate::contracted::is_biconnected;
use crate::chains::motion::{Swap, Velocity, symmetric_motions};
use crate::chains::roles::{Roles, Subject};
use crate::chains::sharing::{Menu, Sharing};
use crate::chains::structure::PairStructure;
use itertools::Itertools;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, PoisonError};

/// A class in which grippers are counted.
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
    /// Its class.
    pub kind: SymmetricKind,
}

/// Returns every essential gripper that moves symmetrically with the input joint carried to itself, separately for mirror images
/// and half turns. Each has the smallest possible number of orbits of pairs that are not hinges.
///
/// # Complexity
/// As of [`crate::chains::visit::visit_pair_chains`], over the halves.
///
/// # Examples
/// ```
/// use ozols::chains::{sharing::Menu, symmetric_census::symmetric_grippers};
/// let hinges = Menu { kinds: &[], most: 0 };
/// assert_eq!(symmetric_grippers(6, hinges).len(), 2);
/// ```
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
            sharing.share_kinds(menu, &mut |chain, automorphisms| {
                let subject = Subject::new(&chain, automorphisms);
                let orbits = subject.other_pairs_up_to(&graph.swap);
                let found = symmetric_roles_of(&subject, graph).into_iter();
                let found = found.map(|(half_turn, roles)| {
                    let driven_jaw = roles.has_driven_jaw();
                    let chain = chain.clone();
                    let key = PairStructure { chain, roles }.canonical_key();
                    (half_turn, driven_jaw, key)
                });
                // Numbered before the lock is taken.
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

/// Returns the grippers of a chain whose motion an involution carries to itself, each with true for half a turn.
fn symmetric_roles_of(subject: &Subject<'_>, graph: &SymmetricGraph) -> Vec<(bool, Roles)> {
    let swap = &graph.swap[..];
    let Some(fixed) = swap.iter().enumerate().position(|(l, &to)| l == to) else {
        return Vec::new();
    };
    let mut out = Vec::new();
    for image in [Symmetry::Mirror, Symmetry::HalfTurn] {
        let swap = Swap { links: swap, image };
        let motions = symmetric_motions(subject.chain, swap, fixed);
        if motions.is_empty() {
            continue;
        }
        for roles in subject.symmetric_roles(swap.links) {
            let moves = |m: &Vec<Velocity>| roles.moves_in(m);
            if motions.iter().any(moves) && subject.is_essential(&roles) {
                out.push((image == Symmetry::HalfTurn, roles));
            }
        }
    }
    out
}

/// Marks two links that change places, whether they are joined or not.
const SWAPPED: u8 = 64;

/// A graph with an involution of its vertices, and the automorphisms that keep the involution.
#[derive(Debug, Clone)]
struct SymmetricGraph {
    pub(super) graph: Weighted,
    pub(super) swap: Vec<usize>,
    pub(super) automorphisms: Vec<Vec<usize>>,
}

fn marked_swap(marked: &Weighted) -> Vec<usize> {
    let n = marked.vertices();
    let image = |u: usize| (0..n).find(|&v| marked.weight(u, v) & SWAPPED > 0);
    (0..n).map(|u| image(u).unwrap_or(u)).collect()
}

fn is_joined(marked: &Weighted, u: usize, v: usize) -> bool {
    marked.weight(u, v) & !SWAPPED > 0
}

/// Returns the graphs with one more orbit of joints: between existing vertices, or from one of them to a new vertex or to two
/// new ones that change places.
fn grow_orbit(marked: &Weighted, most: usize, most_twos: usize) -> Vec<Weighted> {
    let (n, swap) = (marked.vertices(), marked_swap(marked));
    let with_orbit = |graph: &Weighted, joint: [usize; 2], image: [usize; 2]| {
        let mut out = graph.clone();
        for [u, v] in [joint, image] {
            out.set(u, v, out.weight(u, v) | 1);
        }
        out
    };
    let pairs = (0..n).flat_map(|v| (0..v).map(move |u| [u, v]));
    let within = pairs.filter_map(|joint @ [u, v]| {
        let image = joint.map(|l| swap[l]);
        let first = order_links(image) >= joint;
        (first && marked.weight(u, v) & !SWAPPED == 0).then(|| with_orbit(marked, joint, image))
    });
    let mut out: Vec<Weighted> = within.collect();
    let twos = swap.iter().enumerate().filter(|(u, v)| u < *v).count();
    for (u, &image) in swap.iter().enumerate().filter(|(u, v)| u <= *v) {
        if n - 2 * twos < most - 2 * most_twos {
            out.push(with_orbit(&marked.widened(1), [u, n], [image, n]));
        }
        if twos < most_twos {
            let mut two = marked.widened(2);
            two.set(n, n + 1, SWAPPED);
            out.push(with_orbit(&two, [u, n], [image, n + 1]));
        }
    }
    out
}

fn joint_count(marked: &Weighted) -> usize {
    let pairs = (0..marked.vertices()).tuple_combinations();
    pairs.filter(|&(u, v)| is_joined(marked, u, v)).count()
}

/// Returns a lower bound of the joints that are missing at vertices with fewer than two, and at future vertices.
fn lacking_joints(marked: &Weighted, vertices: usize) -> usize {
    let n = marked.vertices();
    let degree = |u: usize| (0..n).filter(|&v| is_joined(marked, u, v)).count();
    let ends: usize = (0..n).map(|u| 2usize.saturating_sub(degree(u))).sum();
    ends.div_ceil(2) + vertices - n
}

/// Returns every graph with this number of vertices and at most `most_edges` edges that stays connected without any one of its
/// vertices, with each involution that moves at least two vertices and keeps one.
///
/// # Complexity
/// One canonical numbering for each orbit that each graph with one orbit fewer may get.
fn symmetric_graphs(vertices: usize, most_edges: usize) -> Vec<SymmetricGraph> {
    let mut out = Vec::new();
    for twos in 1..=(vertices - 1) / 2 {
        let mut level = BTreeSet::from([Weighted::new(1)]);
        while !level.is_empty() {
            let whole = level.iter().filter(|m| m.vertices() == vertices);
            let done = whole.filter(|m| is_biconnected(&unmark_graph(m)));
            out.extend(done.map(graph_of));
            let list: Vec<&Weighted> = level.iter().collect();
            let next = list.into_par_iter().flat_map_iter(|marked| {
                let all = grow_orbit(marked, vertices, twos).into_iter();
                let fits =
                    all.filter(|m| joint_count(m) + lacking_joints(m, vertices) <= most_edges);
                fits.map(|m| number_graph(&m).graph)
            });
            level = next.collect();
        }
    }
    out
}

fn unmark_graph(marked: &Weighted) -> Weighted {
    let n = marked.vertices();
    let mut out = Weighted::new(n);
    for (u, v) in (0..n).tuple_combinations() {
        out.set(u, v, marked.weight(u, v) & !SWAPPED);
    }
    out
}

fn graph_of(marked: &Weighted) -> SymmetricGraph {
    SymmetricGraph {
        swap: marked_swap(marked),
        graph: unmark_graph(marked),
        automorphisms: number_graph(marked).automorphisms,
    }
}
