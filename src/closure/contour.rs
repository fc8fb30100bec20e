//! Independent contours: those the file names, completed to a minimum cycle basis.

use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use itertools::Itertools;
use petgraph::algo::dijkstra;
use petgraph::graph::{NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;

/// A closed walk through joints; `forward` where the walk goes from `links[0]` to `links[1]` of the joint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contour {
    /// The joints in order round the contour, with the direction they are passed in.
    pub joints: Vec<(JointId, bool)>,
    /// The links in order; `links[i]` is left through `joints[i]`.
    pub links: Vec<LinkId>,
}

impl Contour {
    /// The name the field uses: the links in order, as in `0-1-2-3`.
    #[must_use]
    pub fn name(&self, mechanism: &Mechanism) -> String {
        self.links
            .iter()
            .map(|&l| mechanism.links[l].id.as_str())
            .join("-")
    }

    /// The direction a joint is passed in, if it is part of the contour.
    #[must_use]
    pub fn direction(&self, joint: JointId) -> Option<bool> {
        self.joints
            .iter()
            .find(|(j, _)| *j == joint)
            .map(|(_, d)| *d)
    }
}

/// Puts a set of joints that forms one closed walk in order, starting at its first joint; `None` if it is not one.
#[must_use]
pub fn closed_walk(mechanism: &Mechanism, joints: &[JointId]) -> Option<Contour> {
    let mut left: Vec<JointId> = joints.to_vec();
    if left.is_empty() || !left.iter().all_unique() {
        return None;
    }
    let first = left.remove(0);
    let [start, mut at] = mechanism.joints[first].links;
    // Walk on through the file's second joint where the order given allows it.
    if left.first().is_some_and(|&j| {
        mechanism.joints[j].links.contains(&start) && !mechanism.joints[j].links.contains(&at)
    }) {
        at = start;
    }
    let forward = at == mechanism.joints[first].links[1];
    let start = if forward {
        start
    } else {
        mechanism.joints[first].links[1]
    };
    let (mut walk, mut links) = (vec![(first, forward)], vec![start]);
    while !left.is_empty() {
        let i = left
            .iter()
            .position(|&j| mechanism.joints[j].links.contains(&at))?;
        let j = left.remove(i);
        let forward = mechanism.joints[j].links[0] == at;
        links.push(at);
        walk.push((j, forward));
        at = mechanism.joints[j].links[usize::from(forward)];
    }
    (at == start && links.iter().all_unique()).then_some(Contour {
        joints: walk,
        links,
    })
}

/// A basis of the contours of a state: the contours the file names, then those of the free state, each completed by
/// the shortest independent contours (a minimum cycle basis where the file names none).
///
/// # Complexity
/// O(n·(m + n log n)) to find the candidates, O(n·m·k) words of elimination, for n links, m joints, k contours.
///
/// # Sources
/// Horton, "A polynomial-time algorithm to find the shortest cycle basis of a graph", SIAM J. Comput. 16 (1987).
#[must_use]
pub fn contour_basis(mechanism: &Mechanism, state: StateId) -> Vec<Contour> {
    let mut basis = Basis {
        words: mechanism.joints.len().div_ceil(64),
        rows: Vec::new(),
    };
    let mut contours = Vec::new();
    // The contours of the free state come first, so that what a state adds is at the end.
    let states: &[StateId] = if state == 0 { &[0] } else { &[0, state] };
    for &st in states {
        let present: Vec<JointId> = mechanism
            .joints_in(st)
            .filter(|&j| mechanism.joints_in(state).contains(&j))
            .collect();
        let named = mechanism
            .contours
            .iter()
            .filter(|c| c.iter().all(|j| present.contains(j)));
        for walk in named.filter_map(|c| closed_walk(mechanism, c)) {
            if basis.insert(&walk.joints.iter().map(|&(j, _)| j).collect_vec()) {
                contours.push(walk);
            }
        }
        let rank = present.len() + components(mechanism, &present) - touched(mechanism, &present);
        for cycle in shortest_cycles(mechanism, &present) {
            if contours.len() == rank {
                break;
            }
            if basis.insert(&cycle) {
                contours.extend(closed_walk(mechanism, &cycle));
            }
        }
    }
    contours
}

fn touched(mechanism: &Mechanism, joints: &[JointId]) -> usize {
    joints
        .iter()
        .flat_map(|&j| mechanism.joints[j].links)
        .unique()
        .count()
}

fn components(mechanism: &Mechanism, joints: &[JointId]) -> usize {
    let mut sets = petgraph::unionfind::UnionFind::<usize>::new(mechanism.links.len());
    let merged = joints
        .iter()
        .filter(|&&j| sets.union(mechanism.joints[j].links[0], mechanism.joints[j].links[1]))
        .count();
    touched(mechanism, joints) - merged
}

/// Horton's candidates, shortest first: for each link v and joint (x, y), the shortest paths from v with the joint.
fn shortest_cycles(
    mechanism: &Mechanism,
    present: &[JointId],
) -> impl Iterator<Item = Vec<JointId>> {
    // A small distinct excess on each weight makes shortest paths unique, which Horton's theorem needs; it also makes
    // the choice among equals follow the order of the file.
    const UNIT: u64 = 1 << 44;
    let mut graph: UnGraph<(), (JointId, u64)> = UnGraph::default();
    for _ in &mechanism.links {
        graph.add_node(());
    }
    for (i, &j) in present.iter().enumerate() {
        let [a, b] = mechanism.joints[j].links;
        let excess = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 38;
        graph.add_edge(
            NodeIndex::new(a),
            NodeIndex::new(b),
            (j, UNIT + (i as u64 + 1) * (1 << 20) + (excess & 0xf_ffff)),
        );
    }
    let mut candidates: Vec<(u64, Vec<JointId>)> = Vec::new();
    for v in graph.node_indices() {
        let dist = dijkstra(&graph, v, None, |e| e.weight().1);
        let parent = |x: NodeIndex| {
            graph.edges(x).find(|e| {
                let other = if e.source() == x {
                    e.target()
                } else {
                    e.source()
                };
                dist.get(&other)
                    .is_some_and(|d| d + e.weight().1 == dist[&x])
            })
        };
        let path = |mut x: NodeIndex| {
            let mut out = Vec::new();
            while x != v {
                let Some(e) = parent(x) else { break };
                out.push(e.weight().0);
                x = if e.source() == x {
                    e.target()
                } else {
                    e.source()
                };
            }
            out
        };
        for e in graph.edge_references() {
            let (Some(dx), Some(dy)) = (dist.get(&e.source()), dist.get(&e.target())) else {
                continue;
            };
            let tree = dx.abs_diff(*dy) == e.weight().1;
            if tree {
                continue;
            }
            let mut cycle = path(e.source());
            let back = path(e.target());
            if cycle.iter().any(|j| back.contains(j)) {
                continue;
            }
            cycle.push(e.weight().0);
            cycle.extend(back.into_iter().rev());
            candidates.push((dx + dy + e.weight().1, cycle));
        }
    }
    let mut candidates: Vec<(u64, Vec<JointId>, Vec<JointId>)> = candidates
        .into_iter()
        .map(|(w, cycle)| (w, cycle.iter().copied().sorted().collect_vec(), cycle))
        .collect();
    candidates.sort_unstable();
    candidates.dedup_by(|a, b| a.1 == b.1);
    candidates.into_iter().map(|(_, _, cycle)| {
        // Start each contour at its first joint in file order, and go on towards the earlier of its neighbours.
        let first = cycle.iter().position_min().unwrap_or(0);
        let mut rotated = cycle[first..].to_vec();
        rotated.extend_from_slice(&cycle[..first]);
        if rotated.len() > 2 && rotated[1] > rotated[rotated.len() - 1] {
            rotated[1..].reverse();
        }
        rotated
    })
}

/// Independent sets of joints over the field of two elements.
struct Basis {
    words: usize,
    rows: Vec<(usize, Vec<u64>)>,
}

impl Basis {
    fn insert(&mut self, cycle: &[JointId]) -> bool {
        let mut bits = vec![0u64; self.words];
        for &j in cycle {
            bits[j / 64] ^= 1 << (j % 64);
        }
        for (pivot, row) in &self.rows {
            if bits[pivot / 64] >> (pivot % 64) & 1 == 1 {
                bits.iter_mut().zip(row).for_each(|(b, r)| *b ^= r);
            }
        }
        let pivot = bits
            .iter()
            .position(|&w| w != 0)
            .map(|w| w * 64 + bits[w].trailing_zeros() as usize);
        if let Some(pivot) = pivot {
            self.rows.push((pivot, bits));
        }
        pivot.is_some()
    }
}
