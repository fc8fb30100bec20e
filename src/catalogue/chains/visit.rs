//! Every chain of pairs, and the underlying graphs.

use crate::chains::canonical::{Canonical, Weighted, number_graph};
use crate::chains::chain::MOST_LINKS;
use crate::chains::roles::Subject;
use crate::chains::sharing::{Menu, Sharing};
use itertools::Itertools;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Returns the graph with a path of new vertices between two existing ones.
fn with_ear(graph: &Weighted, ends: [usize; 2], new: usize) -> Weighted {
    let n = graph.vertices();
    let mut out = graph.widened(new);
    let way = std::iter::once(ends[0]).chain(n..n + new).chain([ends[1]]);
    for (u, v) in way.tuple_windows() {
        out.set(u, v, 1);
    }
    out
}

fn ring_graph(vertices: usize) -> Weighted {
    let mut out = Weighted::new(vertices);
    (0..vertices).for_each(|v| out.set(v, (v + 1) % vertices, 1));
    out
}

/// The graphs that stay connected without any one of their vertices, each once. They have a given number of loops, and are
/// listed by number of vertices up to a maximum.
///
/// Every such graph with one more loop results from a smaller one by an ear [Whitney 1932]. An ear is a path between two vertices that
/// passes only through new ones. A chain of mobility 1 in which every two links move is such a graph. If one link held two parts together,
/// the mobility would be the sum of theirs.
struct Level {
    most: usize,
    graphs: BTreeMap<usize, BTreeSet<Weighted>>,
}

impl Level {
    fn ring_level(most: usize) -> Level {
        let one = |n| (n, BTreeSet::from([number_graph(&ring_graph(n)).graph]));
        Level {
            most,
            graphs: (3..=most).map(one).collect(),
        }
    }

    /// Returns the graphs with one loop more.
    fn grow_level(&self) -> Level {
        let grown = |n: usize| -> BTreeSet<Weighted> {
            let smaller = self.graphs.iter().filter(|(m, _)| **m <= n);
            let all = smaller.flat_map(|(m, graphs)| graphs.iter().map(move |g| (n - m, g)));
            let all: Vec<(usize, &Weighted)> = all.collect();
            let eared = all.into_par_iter().flat_map_iter(|(new, g)| {
                let ends = (0..g.vertices()).tuple_combinations();
                let free = ends.filter(move |&(u, v)| new > 0 || g.weight(u, v) == 0);
                free.map(move |(u, v)| number_graph(&with_ear(g, [u, v], new)).graph)
            });
            eared.collect()
        };
        Level {
            most: self.most,
            graphs: (4..=self.most).map(|n| (n, grown(n))).collect(),
        }
    }
}

/// Returns every simple biconnected graph with N vertices, by its number of edges up to a maximum. Such a graph stays connected
/// without any one of its vertices. Each graph is in canonical numbering and has its automorphisms.
///
/// # Complexity
/// One canonical numbering for each two vertices of each smaller graph.
#[must_use]
fn biconnected_graphs(vertices: usize, most_edges: usize) -> Vec<Canonical> {
    let mut out = Vec::new();
    let mut level = Level::ring_level(vertices);
    for edges in vertices..=most_edges {
        if edges > vertices {
            level = level.grow_level();
        }
        let own = level.graphs.get(&vertices).into_iter().flatten();
        out.extend(own.map(number_graph));
    }
    out
}

/// Calls `visit` with every chain of N links and with its automorphisms, in no particular order and from several threads.
///
/// # Complexity
/// With slides, some ten microseconds for each way to share the kinds out over a graph. Without slides, one microsecond.
pub fn visit_pair_chains(links: usize, menu: Menu<'_>, visit: &(impl Fn(&Subject<'_>) + Sync)) {
    if !(3..=MOST_LINKS).contains(&links) {
        return;
    }
    let graphs = biconnected_graphs(links, menu.most_joints(links, menu.most));
    graphs.par_iter().for_each(|graph| {
        let own: Vec<usize> = (0..links).collect();
        let sharing = Sharing::new(&graph.graph, &graph.automorphisms, &own);
        sharing.share_kinds(menu, &mut |chain, automorphisms| {
            visit(&Subject::new(&chain, automorphisms));
        });
    });
}
