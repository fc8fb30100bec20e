//! Independent contours: those named in the file, completed to a minimum cycle basis.

use crate::closure::tree::{connected_sets, spanning_forest};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Parts, StateId};
use fixedbitset::FixedBitSet;
use itertools::Itertools;
use petgraph::algo::dijkstra;
use petgraph::graph::{EdgeIndex, EdgeReference, NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// A closed walk through joints. `forward` is true if the walk goes from `links[0]` to `links[1]` of the joint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contour {
    /// The joints in order around the contour, with their direction of passage.
    pub joints: Vec<(JointId, bool)>,
    /// The links in order; the walk leaves `links[i]` through `joints[i]`.
    pub links: Vec<LinkId>,
}

impl Contour {
    /// Returns the name used in the field: the links in order, as in `0-1-2-3`.
    ///
    /// # Examples
    /// ```
    /// use ozols::closure::contour::contour_basis;
    /// use ozols::model::mechanism::StateId;
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let basis = contour_basis(&four_bar, StateId::FREE);
    /// assert_eq!(basis[0].name(&four_bar), "0-1-2-3");
    /// # Ok::<(), ozols::Error>(())
    /// ```
    #[must_use]
    pub fn name(&self, mechanism: &Mechanism) -> String {
        self.links
            .iter()
            .map(|&l| mechanism.links[l].id.as_str())
            .join("-")
    }

    /// Returns the direction of passage of a joint, if it is part of the contour.
    #[must_use]
    pub fn direction_of(&self, joint: JointId) -> Option<bool> {
        self.joints
            .iter()
            .find(|(j, _)| *j == joint)
            .map(|(_, d)| *d)
    }
}

/// Returns a set of joints that forms one closed walk in order, starting at its first joint. Returns `None` if it does
/// not form one.
///
/// # Examples
/// ```
/// use ozols::closure::contour::closed_walk;
/// let four_bar = ozols::built_in("four-bar")?;
/// let joints: Vec<_> = four_bar.joint_ids().collect();
/// assert!(closed_walk(&four_bar, &joints).is_some_and(|c| c.links.len() == 4));
/// assert!(closed_walk(&four_bar, &joints[..3]).is_none()); // It does not return.
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn closed_walk(mechanism: &Parts, joints: &[JointId]) -> Option<Contour> {
    let mut left: Vec<JointId> = joints.to_vec();
    if left.is_empty() || !left.iter().all_unique() {
        return None;
    }
    let first = left.remove(0);
    let [start, mut at] = mechanism.joints[first].links;
    // Prefers the second joint of the file if the given order allows it.
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

/// Returns a basis of the contours of a state. It contains the contours named in the file, then those of the free
/// state, each completed by the shortest independent contours. If the file names none, this is a minimum cycle basis.
///
/// # Complexity
/// O(n·m log m) to find the n·m candidates, for n links, m joints and k contours. Each candidate examined costs O(m/64
/// · k). Only candidates no longer than the longest contour of the basis are examined.
///
/// # Sources
/// Horton, "A polynomial-time algorithm to find the shortest cycle basis of a graph", SIAM J. Comput. 16 (1987).
///
/// # Examples
/// ```
/// use ozols::closure::contour::contour_basis;
/// use ozols::model::mechanism::StateId;
/// let gripper = ozols::built_in("gripper-10").unwrap();
/// assert_eq!(contour_basis(&gripper, StateId::FREE).len(), 4);
/// ```
#[must_use]
pub fn contour_basis(mechanism: &Mechanism, state: StateId) -> Vec<Contour> {
    let (mut basis, joints) = (Basis::default(), mechanism.joints.len());
    let mut contours = Vec::new();
    // The contours of the free state come first, so that those added by a state are at the end.
    let states: &[StateId] = if state == StateId::FREE {
        &[StateId::FREE]
    } else {
        &[StateId::FREE, state]
    };
    for &st in states {
        let both = mechanism.joints_in(st);
        let both = both.filter(|&j| mechanism.joints[j].is_in(state));
        let present: Vec<JointId> = both.collect();
        let named = mechanism
            .contours
            .iter()
            .filter(|c| c.iter().all(|j| present.contains(j)));
        for walk in named.filter_map(|c| closed_walk(mechanism, c)) {
            let passed = walk.joints.iter().map(|(j, _)| j.index());
            if basis.insert_cycle(passed, joints) {
                contours.push(walk);
            }
        }
        let ends = present.iter().map(|&j| mechanism.joints[j].links);
        let ends: Vec<[usize; 2]> = ends.map(|links| links.map(LinkId::index)).collect();
        let links = mechanism.links.len();
        let (_, tree) = spanning_forest(links, ends.iter().copied(), |_| false, 0..links);
        for cycle in shortest_cycles(links, &ends) {
            // As many are independent as joints lie outside a tree.
            if contours.len() == present.len() - tree.len() {
                break;
            }
            let cycle: Vec<JointId> = cycle.into_iter().map(|e| present[e]).collect();
            if basis.insert_cycle(cycle.iter().map(|j| j.index()), joints) {
                contours.extend(closed_walk(mechanism, &cycle));
            }
        }
    }
    contours
}

/// Returns a shortest basis of the cycles of a graph, each by the indices of its edges.
///
/// # Complexity
/// As [`contour_basis`], with every candidate examined.
///
/// # Examples
/// ```
/// use ozols::closure::contour::shortest_cycle_basis;
/// // A square with a diagonal: two triangles.
/// let basis = shortest_cycle_basis(4, &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]);
/// assert_eq!(basis, [[0, 1, 4], [2, 3, 4]]);
/// ```
#[must_use]
pub fn shortest_cycle_basis(nodes: usize, edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut basis = Basis::default();
    let mut adds = |c: &Vec<usize>| basis.insert_cycle(c.iter().copied(), edges.len());
    shortest_cycles(nodes, edges).filter(|c| adds(c)).collect()
}

/// Returns the edges of each biconnected block of a graph. Edges that are in no cycle are omitted.
fn biconnected_blocks(nodes: usize, edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let (_, steps) = spanning_forest(nodes, edges.iter().copied(), |_| false, 0..nodes);
    let mut depth = vec![0_usize; nodes];
    let mut back: Vec<Option<(usize, usize)>> = vec![None; nodes];
    let mut closing = vec![true; edges.len()];
    for s in &steps {
        depth[s.link] = depth[s.from] + 1;
        back[s.link] = Some((s.from, s.joint));
        closing[s.joint] = false;
    }
    let cycle = |e: usize| {
        let ([mut a, mut b], mut out) = (edges[e], vec![e]);
        while a != b {
            let deeper = if depth[a] < depth[b] { &mut b } else { &mut a };
            let Some((from, joint)) = back[*deeper] else {
                break;
            };
            *deeper = from;
            out.push(joint);
        }
        out
    };
    connected_sets((0..edges.len()).filter(|&e| closing[e]).map(cycle))
}

/// Returns Horton's candidates, shortest first: for each node v and edge (x, y) of a block, the shortest paths from v with the edge.
fn shortest_cycles(nodes: usize, edges: &[[usize; 2]]) -> impl Iterator<Item = Vec<usize>> {
    // A small distinct excess on each weight makes shortest paths unique, which Horton's theorem requires. It also
    // makes the choice among equal ones follow the order of the edges.
    const UNIT: u64 = 1 << 44;
    let weighed = |edge: usize| {
        let i = edge as u64 + 1;
        let excess = i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 38;
        WeighedEdge {
            edge,
            length: UNIT + i * (1 << 20) + (excess & 0xf_ffff),
        }
    };
    // A cycle lies within one block, and so do the shortest paths between nodes of a block.
    let graph = |block: Vec<usize>| {
        let (mut graph, mut nodes) = (Graph::default(), BTreeMap::new());
        for e in block {
            let [a, b] = edges[e].map(|n| *nodes.entry(n).or_insert_with(|| graph.add_node(())));
            graph.add_edge(a, b, weighed(e));
        }
        graph
    };
    let graphs: Vec<Graph> = biconnected_blocks(nodes, edges)
        .into_iter()
        .map(graph)
        .collect();
    let of = |(g, graph): (usize, &Graph)| {
        let tree = |v| (g, Tree::new(graph, v));
        graph.node_indices().map(tree).collect_vec()
    };
    let trees: Vec<(usize, Tree)> = graphs.iter().enumerate().flat_map(of).collect();
    // (length, v, edge): the edges of a cycle are only listed on demand.
    let mut heap: BinaryHeap<Reverse<(u64, usize, usize)>> = trees
        .iter()
        .enumerate()
        .flat_map(|(v, (g, tree))| {
            let closing = graphs[*g]
                .edge_references()
                .filter_map(|e| tree.closing_length(e));
            closing.map(move |(length, e)| Reverse((length, v, e)))
        })
        .collect::<Vec<_>>()
        .into();
    let mut waiting: Vec<Vec<usize>> = Vec::new();
    std::iter::from_fn(move || {
        if waiting.is_empty() {
            // All of one length, almost always one cycle found from each of its nodes.
            let Reverse((length, ..)) = heap.peek()?;
            let length = *length;
            let mut equal: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
            while let Some(Reverse((l, v, e))) = heap.peek().copied() {
                if l != length {
                    break;
                }
                heap.pop();
                let (g, tree) = &trees[v];
                let cycle = tree.closing_cycle(&graphs[*g], e);
                equal.push((cycle.iter().copied().sorted().collect_vec(), cycle));
            }
            equal.sort_unstable();
            equal.dedup_by(|a, b| a.0 == b.0);
            waiting.extend(equal.into_iter().rev().map(|(_, cycle)| from_first(&cycle)));
        }
        waiting.pop()
    })
}

/// An edge with its length in walks.
struct WeighedEdge {
    edge: usize,
    /// A unit, and a small excess that no other edge has.
    length: u64,
}

type Graph = UnGraph<(), WeighedEdge>;

/// Returns the end of an edge that is not `x`.
fn other_end(e: EdgeReference<'_, WeighedEdge>, x: NodeIndex) -> NodeIndex {
    if e.source() == x {
        e.target()
    } else {
        e.source()
    }
}

/// Shortest paths from one node.
struct Tree {
    /// Distance of each reachable node.
    dist: Vec<Option<u64>>,
    /// The last edge on the path to each node.
    last: Vec<Option<EdgeIndex>>,
    /// The first edge on the path to each node. Paths with different first edges do not meet.
    first: Vec<Option<EdgeIndex>>,
}

impl Tree {
    /// Runs Dijkstra's algorithm, O(m log m).
    fn new(graph: &Graph, from: NodeIndex) -> Tree {
        let found = dijkstra(graph, from, None, |e| e.weight().length);
        let dist: Vec<Option<u64>> = graph
            .node_indices()
            .map(|x| found.get(&x).copied())
            .collect();
        let settled = graph.node_indices().filter(|x| dist[x.index()].is_some());
        let settled = settled.sorted_by_key(|x| dist[x.index()]);
        let mut last = vec![None; graph.node_count()];
        let mut first = vec![None; graph.node_count()];
        for x in settled.skip(1) {
            let back = graph.edges(x).find(|e| {
                let before = dist[other_end(*e, x).index()];
                before.map(|d| d + e.weight().length) == dist[x.index()]
            });
            if let Some(e) = back {
                last[x.index()] = Some(e.id());
                first[x.index()] = first[other_end(e, x).index()].or(Some(e.id()));
            }
        }
        Tree { dist, last, first }
    }

    /// Returns the length of the closed walk through an edge, if the two shortest paths to its ends share only their
    /// first node. O(1).
    fn closing_length(&self, e: EdgeReference<'_, WeighedEdge>) -> Option<(u64, usize)> {
        let (x, y) = (e.source().index(), e.target().index());
        let (dx, dy) = (self.dist[x]?, self.dist[y]?);
        let in_tree = dx.abs_diff(dy) == e.weight().length;
        let apart = self.first[x] != self.first[y];
        (!in_tree && apart).then(|| (dx + dy + e.weight().length, e.id().index()))
    }

    /// Returns the edges of that walk, in order.
    fn closing_cycle(&self, graph: &Graph, e: usize) -> Vec<usize> {
        let e = EdgeIndex::new(e);
        let Some((x, y)) = graph.edge_endpoints(e) else {
            return Vec::new();
        };
        let path = |mut x: NodeIndex| {
            let mut out = Vec::new();
            while let Some(e) = self.last[x.index()] {
                out.push(graph[e].edge);
                let Some((a, b)) = graph.edge_endpoints(e) else {
                    break;
                };
                x = if a == x { b } else { a };
            }
            out
        };
        let mut cycle = path(x);
        cycle.push(graph[e].edge);
        cycle.extend(path(y).into_iter().rev());
        cycle
    }
}

/// Rotates a cycle to its first edge, continuing towards the earlier of its neighbours.
fn from_first(cycle: &[usize]) -> Vec<usize> {
    let first = cycle.iter().position_min().unwrap_or(0);
    let mut rotated = cycle[first..].to_vec();
    rotated.extend_from_slice(&cycle[..first]);
    if rotated.len() > 2 && rotated[1] > rotated[rotated.len() - 1] {
        rotated[1..].reverse();
    }
    rotated
}

/// Independent sets of edges over the field of two elements.
#[derive(Default)]
struct Basis {
    rows: Vec<(usize, FixedBitSet)>,
}

impl Basis {
    fn insert_cycle(&mut self, cycle: impl Iterator<Item = usize>, edges: usize) -> bool {
        let mut bits = FixedBitSet::with_capacity(edges);
        cycle.for_each(|e| bits.toggle(e));
        for (pivot, row) in &self.rows {
            if bits.contains(*pivot) {
                bits.symmetric_difference_with(row);
            }
        }
        let pivot = bits.minimum();
        self.rows.extend(pivot.map(|pivot| (pivot, bits)));
        pivot.is_some()
    }
}
