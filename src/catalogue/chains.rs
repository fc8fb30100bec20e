//! Kinematic chains: which links may be joined to which, before anything has a place. Links are vertices, joints edges.
//!
//! A planar chain of n links and e hinges has the mobility W = 3(n - 1) - 2e; it has no rigid part if every part of two
//! links or more has a mobility of at least 1. Chains are listed without two that differ only in numbering.

pub mod canonical;
pub mod census;
pub(crate) mod contracted;
pub mod enumerate;
pub mod graph6;
pub mod layout_symmetry;
pub mod pairs;
pub mod roles;
mod strings;

use crate::chains::canonical::{Canonical, Weighted, canonical};

/// Most links of a chain: sets of links are the bits of a word, and tables of all of them are made.
pub(crate) const MOST_LINKS: usize = 20;

/// A chain: links 0..n, and which are joined.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Chain {
    /// For each link, the links it is joined to, as bits.
    pub neighbours: Vec<u32>,
}

impl Chain {
    /// A chain of so many links with these joints.
    #[must_use]
    pub fn new(links: usize, joints: impl IntoIterator<Item = (usize, usize)>) -> Chain {
        let mut neighbours = vec![0; links];
        for (u, v) in joints {
            neighbours[u] |= 1 << v;
            neighbours[v] |= 1 << u;
        }
        Chain { neighbours }
    }

    /// The links of a contracted graph with its strings, each with its number of joints and so with one binary link fewer.
    pub(crate) fn of_strings(links: usize, ends: &[(usize, usize)], joints: &[u8]) -> Chain {
        let binary: usize = joints.iter().map(|&x| usize::from(x) - 1).sum();
        let mut next = links;
        let mut all = Vec::with_capacity(links + binary);
        for (&(u, v), &x) in ends.iter().zip(joints) {
            let mut at = u;
            for _ in 1..x {
                all.push((at, next));
                (at, next) = (next, next + 1);
            }
            all.push((at, v));
        }
        Chain::new(links + binary, all)
    }

    /// Number of links.
    #[must_use]
    pub fn links(&self) -> usize {
        self.neighbours.len()
    }

    /// Whether two links are joined.
    #[must_use]
    pub fn joined(&self, u: usize, v: usize) -> bool {
        self.neighbours[u] >> v & 1 == 1
    }

    /// The joints, each by its links, the lesser first.
    #[must_use]
    pub fn joints(&self) -> Vec<(usize, usize)> {
        let n = self.links();
        let pairs = (0..n).flat_map(|v| (0..v).map(move |u| (u, v)));
        pairs.filter(|&(u, v)| self.joined(u, v)).collect()
    }

    /// Number of joints.
    #[must_use]
    pub fn joint_count(&self) -> usize {
        let ends: u32 = self.neighbours.iter().map(|x| x.count_ones()).sum();
        ends as usize / 2
    }

    /// The mobility 3(n - 1) - 2e of the links of a set, given as bits, with the joints between them.
    #[must_use]
    pub(crate) fn mobility_of(&self, part: u32) -> i64 {
        let inside = |v: &usize| part >> v & 1 == 1;
        let ends = (0..self.links())
            .filter(inside)
            .map(|v| (self.neighbours[v] & part).count_ones());
        3 * (i64::from(part.count_ones()) - 1) - i64::from(ends.sum::<u32>())
    }

    /// The mobility of the chain.
    #[must_use]
    pub fn mobility(&self) -> i64 {
        self.mobility_of(self.all())
    }

    /// All links, as bits.
    #[must_use]
    pub fn all(&self) -> u32 {
        (1 << self.links()) - 1
    }

    /// The chain in its canonical numbering, with its automorphisms.
    ///
    /// # Complexity
    /// One refinement for each automorphism, and some.
    #[must_use]
    pub fn canonical(&self) -> (Chain, Vec<Vec<usize>>) {
        let n = self.links();
        let mut graph = Weighted::new(n);
        self.joints()
            .into_iter()
            .for_each(|(u, v)| graph.set(u, v, 1));
        let Canonical {
            order,
            automorphisms,
            ..
        } = canonical(&graph);
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(at, &v)| place[v] = at);
        let joints = self.joints().into_iter().map(|(u, v)| (place[u], place[v]));
        let renumbered = |a: &Vec<usize>| order.iter().map(|&v| place[a[v]]).collect();
        (
            Chain::new(n, joints),
            automorphisms.iter().map(renumbered).collect(),
        )
    }
}
