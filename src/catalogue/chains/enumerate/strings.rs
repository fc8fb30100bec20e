//! The numbers of joints of each string of a chain. These are all distributions of joints over the edges of a contracted graph without a
//! rigid part, each once up to the graph's symmetries.

use crate::chains::canonical::{Weighted, number_graph};
use crate::chains::enumerate::contracted::repeated_edges;
use itertools::Itertools;
use std::collections::BTreeSet;

/// A part of the chain: the links of some vertices with all strings between them.
struct ChainPart {
    /// Its edges.
    edges: u64,
    /// Minimum number of its joints, at most three counted per string. With a longer string, the part without it decides.
    least: u32,
}

/// The strings of a contracted graph.
pub(super) struct Strings {
    /// Links at their ends. Strings between the same two links are adjacent in the list.
    pub(super) ends: Vec<(usize, usize)>,
    /// For each string, the parts of which it is the last one.
    parts: Vec<Vec<ChainPart>>,
    /// Images of the strings under the symmetries.
    images: Vec<Vec<usize>>,
}

/// Mobility that a loop removes: a part with J joints and k loops has the mobility J - 3k, which must be at least 1.
const LOOP: usize = 3;

/// The joints given to strings so far.
struct Shared {
    joints: Vec<u8>,
    /// Bit planes of the numbers, at most three per string.
    ones: u64,
    twos: u64,
}

impl Strings {
    pub(super) fn new(graph: &Weighted) -> Strings {
        let n = graph.vertices();
        let mut ends = repeated_edges(graph);
        // Parts of the first few vertices are whole early.
        ends.sort_by_key(|&(u, v)| (v, u));
        let mut parts: Vec<Vec<ChainPart>> = ends.iter().map(|_| Vec::new()).collect();
        for part in 1u32..1 << n {
            let inside = |&&(u, v): &&(usize, usize)| part >> u & part >> v & 1 == 1;
            let own = ends.iter().positions(|e| inside(&e)).collect_vec();
            let links = part.count_ones() as usize;
            let at = |v: usize| {
                own.iter()
                    .filter(|&&e| ends[e].0 == v || ends[e].1 == v)
                    .count()
            };
            // A part that is not connected, or has a link on only one string, is decided by its pieces.
            let whole = (0..n).filter(|v| part >> v & 1 == 1).all(|v| at(v) > 1);
            let Some(&last) = own.last().filter(|_| whole) else {
                continue;
            };
            let least = LOOP * (own.len() + 1 - links) + 1;
            parts[last].push(ChainPart {
                edges: own.iter().map(|&e| 1 << e).sum(),
                least: u32::try_from(least).unwrap_or(u32::MAX),
            });
        }
        let place = |u: usize, v: usize| {
            let pair = (u.min(v), u.max(v));
            ends.iter().position(|&e| e == pair).unwrap_or(0)
        };
        let automorphisms = number_graph(graph).automorphisms;
        let image = |a: &Vec<usize>| {
            let to = |(i, &(u, v)): (usize, &(usize, usize))| place(a[u], a[v]) + i - place(u, v);
            ends.iter().enumerate().map(to).collect_vec()
        };
        let images: BTreeSet<Vec<usize>> = automorphisms.iter().map(image).collect();
        let moved = |i: &Vec<usize>| i.iter().enumerate().any(|(k, &to)| k != to);
        Strings {
            images: images.into_iter().filter(moved).collect(),
            parts,
            ends,
        }
    }

    /// Distributes `joints`, at most `most` per string.
    pub(super) fn share_joints(&self, joints: usize, most: u8, visit: &mut impl FnMut(&[u8])) {
        let mut shared = Shared {
            joints: vec![0; self.ends.len()],
            ones: 0,
            twos: 0,
        };
        self.next(0, joints, most, &mut shared, visit);
    }

    fn next(
        &self,
        at: usize,
        left: usize,
        most: u8,
        shared: &mut Shared,
        visit: &mut impl FnMut(&[u8]),
    ) {
        if at == self.ends.len() {
            if left == 0 && self.is_first(&shared.joints) {
                visit(&shared.joints);
            }
            return;
        }
        let after = self.ends.len() - at - 1;
        // The longest of the strings between the same links comes first.
        let alike = at > 0 && self.ends[at - 1] == self.ends[at];
        let most_here = if alike { shared.joints[at - 1] } else { most };
        let (ones, twos) = (shared.ones, shared.twos);
        for n in (1..=most_here).rev() {
            let Some(rest) = left.checked_sub(n.into()).filter(|&r| r >= after) else {
                continue;
            };
            if rest > after * usize::from(most) {
                break;
            }
            shared.joints[at] = n;
            let capped = u64::from(n.min(3));
            shared.ones = ones | (capped & 1) << at;
            shared.twos = twos | (capped >> 1) << at;
            let moves = |p: &ChainPart| {
                let joints =
                    (shared.ones & p.edges).count_ones() + 2 * (shared.twos & p.edges).count_ones();
                joints >= p.least
            };
            // The fewer joints a string has, the more rigid are its parts.
            if !self.parts[at].iter().all(moves) {
                break;
            }
            self.next(at + 1, rest, most, shared, visit);
        }
        (shared.ones, shared.twos) = (ones, twos);
    }

    /// Returns true if no symmetry gives a greater list.
    fn is_first(&self, joints: &[u8]) -> bool {
        let own = joints.iter();
        self.images
            .iter()
            .all(|image| image.iter().map(|&e| &joints[e]).cmp(own.clone()).is_le())
    }
}
