//! The contour basis is a minimum cycle basis: against a greedy choice among all cycles of small graphs.

use crate::common::*;
mod shares;

use ozols::closure::contour::{closed_walk, contour_basis};
use ozols::redundancy::state_figures;
use petgraph::algo::dijkstra;
use petgraph::graph::{NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;
use proptest::prelude::*;

/// A mechanism whose graph has these edges; joints are all alike, only the graph matters.
fn text(links: usize, edges: &[(usize, usize)]) -> String {
    let mut out = String::from("name = \"graph\"\n");
    for l in 0..links {
        let role = match l {
            0 => "role = \"frame\"\n",
            1 => "role = \"output\"\n",
            _ => "",
        };
        out += &format!("[[link]]\nid = \"{l}\"\n{role}");
    }
    for (i, (a, b)) in edges.iter().enumerate() {
        out += &format!(
            "[[joint]]\nid = \"j{i}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"spherical\"\npoint = [{i}, 0, 0]\n"
        );
    }
    out
}

/// Total length of a minimum cycle basis: all simple cycles as edge sets, shortest first, kept while independent.
fn least_total(links: usize, edges: &[(usize, usize)]) -> usize {
    let mut cycles: Vec<u32> = (1u32..1 << edges.len())
        .filter(|set| {
            let chosen: Vec<_> = (0..edges.len())
                .filter(|i| set >> i & 1 == 1)
                .map(|i| edges[i])
                .collect();
            let degree = |l: usize| chosen.iter().filter(|(a, b)| *a == l || *b == l).count();
            let used: Vec<usize> = (0..links).filter(|&l| degree(l) > 0).collect();
            let mut reached = vec![used[0]];
            for _ in 0..links {
                for (a, b) in &chosen {
                    if reached.contains(a) != reached.contains(b) {
                        reached.push(if reached.contains(a) { *b } else { *a });
                    }
                }
            }
            used.iter().all(|&l| degree(l) == 2) && used.iter().all(|l| reached.contains(l))
        })
        .collect();
    cycles.sort_by_key(|c| c.count_ones());
    let (mut basis, mut total): (Vec<u32>, u32) = (Vec::new(), 0);
    for cycle in cycles {
        let reduced = basis.iter().fold(cycle, |c, b| c.min(c ^ b));
        if reduced != 0 {
            basis.push(reduced);
            basis.sort_unstable_by(|a, b| b.cmp(a));
            total += cycle.count_ones();
        }
    }
    total as usize
}

/// The slow twin: Horton's candidates, every one written out by walking up shortest paths, then sorted.
fn shortest_cycles(mechanism: &Mechanism, present: &[JointId]) -> Vec<Vec<JointId>> {
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
            NodeIndex::new(a.index()),
            NodeIndex::new(b.index()),
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
    let rotate = |cycle: Vec<JointId>| {
        // Start each contour at its first joint in file order, and go on towards the earlier of its neighbours.
        let first = cycle.iter().position_min().unwrap_or(0);
        let mut rotated = cycle[first..].to_vec();
        rotated.extend_from_slice(&cycle[..first]);
        if rotated.len() > 2 && rotated[1] > rotated[rotated.len() - 1] {
            rotated[1..].reverse();
        }
        rotated
    };
    candidates
        .into_iter()
        .map(|(_, _, cycle)| rotate(cycle))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn contours_are_those_of_the_slow_twin(
        links in 3usize..16,
        tree in proptest::collection::vec(any::<prop::sample::Index>(), 15),
        more in proptest::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..14),
    ) {
        let mut edges: Vec<(usize, usize)> = (1..links).map(|l| (tree[l - 1].index(l), l)).collect();
        edges.extend(more.iter().map(|(a, b)| (a.index(links), b.index(links))).filter(|(a, b)| a != b));
        let m = mechanism_from_str("graph.toml", &text(links, &edges)).unwrap();
        let joints: Vec<JointId> = m.joint_ids().collect();
        let mut span: Vec<u32> = Vec::new();
        let independent = |cycle: &Vec<JointId>| {
            let bits = cycle.iter().fold(0u32, |b, j| b | 1 << j.index());
            let left = span.iter().fold(bits, |c, b| c.min(c ^ b));
            if left != 0 {
                span.push(left);
                span.sort_unstable_by(|a, b| b.cmp(a));
            }
            left != 0
        };
        let twin = shortest_cycles(&m, &joints).into_iter().filter(independent);
        let twin: Vec<_> = twin.map(|c| closed_walk(&m, &c).unwrap()).collect();
        prop_assert_eq!(contour_basis(&m, StateId::FREE), twin);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn contours_are_a_minimum_cycle_basis(
        links in 3usize..7,
        tree in proptest::collection::vec(any::<prop::sample::Index>(), 6),
        more in proptest::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..6),
    ) {
        let mut edges: Vec<(usize, usize)> = (1..links).map(|l| (tree[l - 1].index(l), l)).collect();
        edges.extend(more.iter().map(|(a, b)| (a.index(links), b.index(links))).filter(|(a, b)| a != b));
        let m = mechanism_from_str("graph.toml", &text(links, &edges)).unwrap();
        let basis = contour_basis(&m, StateId::FREE);
        prop_assert_eq!(basis.len(), edges.len() + 1 - links);
        prop_assert_eq!(basis.iter().map(|c| c.joints.len()).sum::<usize>(), least_total(links, &edges));
    }
}

/// What `ozols list` tells of a state is what an analysis finds.
#[test]
fn figures_told_at_once_are_those_of_the_analysis() {
    for name in ozols::builtin::names() {
        let m = built_in(name);
        if m.joints.len() > 30 {
            continue;
        }
        let found = state_figures(&m, StateId::FREE).unwrap();
        let whole = analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap();
        let whole = &whole[0];
        assert_eq!(
            [found.links, found.joints, found.contours, found.freedoms],
            [whole.links, whole.joints, whole.contours, whole.freedoms],
            "{name}"
        );
        assert_eq!(
            (found.mobility, found.redundant),
            (whole.mobility, whole.redundant),
            "{name}"
        );
    }
    // A four-bar of hinges: one contour, four freedoms of rank three.
    let bar = state_figures(&built_in("four-bar"), StateId::FREE).unwrap();
    assert_eq!((bar.contours, bar.freedoms), (1, 4));
    assert_eq!((bar.mobility, bar.redundant), (1, 3));
    // Malyshev's formula: six for each of three moving links, less five at each of four hinges.
    let bar = built_in("four-bar");
    let found = analyse_states(&bar, &[StateId::FREE], Method::Modular).unwrap();
    assert_eq!(found[0].formula_mobility, 6 * 3 - 5 * 4);
}

/// Two double edges that meet in one link are two contours, and no walk of one.
#[test]
fn a_walk_comes_through_a_link_once() {
    let m = mechanism_from_str("eight.toml", &text(3, &[(0, 1), (1, 0), (0, 2), (2, 0)])).unwrap();
    let joints: Vec<JointId> = m.joint_ids().collect();
    assert!(closed_walk(&m, &joints).is_none());
    assert!(closed_walk(&m, &joints[..2]).is_some() && closed_walk(&m, &joints[2..]).is_some());
}

/// A contour that the file names is in the basis, though shorter ones would do.
#[test]
fn contours_that_are_named_are_taken_first() {
    let edges = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)];
    let named = text(4, &edges) + "[[contour]]\njoints = [\"j0\", \"j1\", \"j2\", \"j3\"]\n";
    for (text, longest) in [(text(4, &edges), 3), (named, 4)] {
        let m = mechanism_from_str("named.toml", &text).unwrap();
        let basis = contour_basis(&m, StateId::FREE);
        assert_eq!(basis.len(), 2);
        assert_eq!(basis.iter().map(|c| c.joints.len()).max(), Some(longest));
    }
}
