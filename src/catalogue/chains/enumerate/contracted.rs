//! Contracted graphs: chains with each string of binary links drawn as one edge. Vertices are the links with three joints or
//! more.
//!
//! Chains whose mobility is not the sum of two parts' stay connected without any one of their links, and so do their contracted graphs.
//! Those with k loops are the cubic ones (2(k - 1) vertices) and the contractions of their edges. The reason is that a vertex of four or
//! more edges can be split in two without losing this property. Cubic graphs with k + 1 loops result from those with k by a new edge
//! between the middles of two edges, or of one.

use crate::chains::canonical::{Weighted, number_graph};
use itertools::Itertools;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Returns true if the graph stays connected without any one of its vertices.
pub(in crate::chains) fn is_biconnected(graph: &Weighted) -> bool {
    let n = graph.vertices();
    let all = (1u32 << n) - 1;
    let near: Vec<u32> = (0..n)
        .map(|u| {
            (0..n)
                .filter(|&v| graph.weight(u, v) > 0)
                .map(|v| 1 << v)
                .sum()
        })
        .collect();
    (0..n).all(|out| {
        let inside = all & !(1 << out);
        let mut reached = inside & inside.wrapping_neg();
        loop {
            let at = (0..n).filter(|v| reached >> v & 1 == 1);
            let next = at.fold(reached, |r, v| r | near[v]) & inside;
            if next == reached {
                return reached == inside;
            }
            reached = next;
        }
    })
}

/// Returns the edges, each as often as its weight.
pub(super) fn repeated_edges(graph: &Weighted) -> Vec<(usize, usize)> {
    let pairs = (0..graph.vertices()).tuple_combinations();
    let repeated = |(u, v)| std::iter::repeat_n((u, v), graph.weight(u, v).into());
    pairs.flat_map(repeated).collect()
}

/// Returns a cubic graph with one more loop: a new edge between the middles of two edges.
fn with_edge_between(graph: &Weighted, edges: [(usize, usize); 2], same: bool) -> Weighted {
    let n = graph.vertices();
    let mut out = graph.widened(2);
    let mut add = |u: usize, v: usize, by: i8| {
        let weight = out.weight(u, v).saturating_add_signed(by);
        out.set(u, v, weight);
    };
    let [(a, b), (c, d)] = edges;
    if same {
        add(a, b, -1);
        add(a, n, 1);
        add(n, n + 1, 2);
        add(n + 1, b, 1);
    } else {
        add(a, b, -1);
        add(c, d, -1);
        for (end, middle) in [(a, n), (b, n), (c, n + 1), (d, n + 1), (n, n + 1)] {
            add(end, middle, 1);
        }
    }
    out
}

/// Returns the graph with an edge contracted, its second end into the first.
fn contract_edge(graph: &Weighted, into: usize, gone: usize) -> Weighted {
    let kept: Vec<usize> = (0..graph.vertices()).filter(|&v| v != gone).collect();
    let mut out = graph.renumbered(&kept);
    let place = |v: usize| v - usize::from(v > gone);
    for &v in kept.iter().filter(|&&v| v != into) {
        let weight = graph.weight(into, v) + graph.weight(gone, v);
        out.set(place(into), place(v), weight);
    }
    out
}

fn distinct_graphs(candidates: impl ParallelIterator<Item = Weighted>) -> BTreeSet<Weighted> {
    candidates.map(|g| number_graph(&g).graph).collect()
}

/// Returns every contracted graph with this number of loops, two or more, in canonical numbering and in order.
///
/// # Complexity
/// One canonical numbering for each edge of each graph.
#[must_use]
pub(crate) fn contracted_graphs(loops: usize) -> Vec<Weighted> {
    let mut dipole = Weighted::new(2);
    dipole.set(0, 1, 3);
    let mut cubic = BTreeSet::from([dipole]);
    for _ in 2..loops {
        let list: Vec<&Weighted> = cubic.iter().collect();
        let grown = list.into_par_iter().flat_map_iter(|g| {
            let all = repeated_edges(g);
            let single = all.iter().dedup().map(|&e| ([e, e], true)).collect_vec();
            let pairs = all.iter().copied().tuple_combinations();
            let pairs = pairs.dedup().map(|(e, f)| ([e, f], false)).collect_vec();
            let both = single.into_iter().chain(pairs);
            both.map(|(e, same)| with_edge_between(g, e, same))
        });
        cubic = distinct_graphs(grown);
    }
    let mut out: Vec<Weighted> = Vec::new();
    let mut level = cubic;
    while !level.is_empty() {
        let list: Vec<&Weighted> = level.iter().collect();
        let smaller = list.into_par_iter().flat_map_iter(|g| {
            let pairs = (0..g.vertices()).tuple_combinations();
            let single = pairs.filter(|&(u, v)| g.weight(u, v) == 1).collect_vec();
            let drawn = single.into_iter().map(|(u, v)| contract_edge(g, u, v));
            drawn.filter(|g| g.vertices() > 1 && is_biconnected(g))
        });
        let next = distinct_graphs(smaller);
        out.extend(level);
        level = next;
    }
    out
}
