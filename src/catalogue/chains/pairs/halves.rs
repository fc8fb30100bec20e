//! Graphs that lie on themselves, made by halves: a half is drawn once, and its image comes with it.
//!
//! Links either are their own images or change places with another. An orbit of joints is one that is its own image, or two
//! that change places. Graphs grow by one orbit at a time, in every way that differs by more than numbering.

use crate::chains::canonical::{Weighted, canonical};
use crate::chains::contracted::is_biconnected;
use crate::chains::pairs::chain::ordered;
use itertools::Itertools;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Marks two links that change places, whether they are joined or not.
const SWAPPED: u8 = 64;

/// A graph with where an involution takes its vertices, and the automorphisms that keep the involution.
#[derive(Debug, Clone)]
pub(super) struct SymmetricGraph {
    pub(super) graph: Weighted,
    pub(super) swap: Vec<usize>,
    pub(super) automorphisms: Vec<Vec<usize>>,
}

fn swap(marked: &Weighted) -> Vec<usize> {
    let n = marked.vertices();
    let image = |u: usize| (0..n).find(|&v| marked.weight(u, v) & SWAPPED > 0);
    (0..n).map(|u| image(u).unwrap_or(u)).collect()
}

fn is_joined(marked: &Weighted, u: usize, v: usize) -> bool {
    marked.weight(u, v) & !SWAPPED > 0
}

/// A graph with one orbit of joints more, in every way that joins the new ones to it: between its own vertices, or from one
/// of them to a new one or to two new ones that change places.
fn grown(marked: &Weighted, most: usize, most_twos: usize) -> Vec<Weighted> {
    let (n, swap) = (marked.vertices(), swap(marked));
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
        let first = ordered(image) >= joint;
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

/// Joints that the vertices of fewer than two lack, at least, and those that are to come.
fn lacking(marked: &Weighted, vertices: usize) -> usize {
    let n = marked.vertices();
    let degree = |u: usize| (0..n).filter(|&v| is_joined(marked, u, v)).count();
    let ends: usize = (0..n).map(|u| 2usize.saturating_sub(degree(u))).sum();
    ends.div_ceil(2) + vertices - n
}

/// Every graph of so many vertices and so many edges at most that hangs together without any one of its vertices, with
/// each way to lie on itself that moves two vertices at least and keeps one.
///
/// # Complexity
/// One canonical numbering for each orbit that each graph with one orbit fewer may get.
pub(super) fn symmetric_graphs(vertices: usize, most_edges: usize) -> Vec<SymmetricGraph> {
    let mut out = Vec::new();
    for twos in 1..=(vertices - 1) / 2 {
        let mut level = BTreeSet::from([Weighted::new(1)]);
        while !level.is_empty() {
            let whole = level.iter().filter(|m| m.vertices() == vertices);
            let done = whole.filter(|m| is_biconnected(&unmarked(m)));
            out.extend(done.map(graph_of));
            let list: Vec<&Weighted> = level.iter().collect();
            let next = list.into_par_iter().flat_map_iter(|marked| {
                let all = grown(marked, vertices, twos).into_iter();
                let fits = all.filter(|m| joint_count(m) + lacking(m, vertices) <= most_edges);
                fits.map(|m| canonical(&m).graph)
            });
            level = next.collect();
        }
    }
    out
}

fn unmarked(marked: &Weighted) -> Weighted {
    let n = marked.vertices();
    let mut out = Weighted::new(n);
    for (u, v) in (0..n).tuple_combinations() {
        out.set(u, v, marked.weight(u, v) & !SWAPPED);
    }
    out
}

fn graph_of(marked: &Weighted) -> SymmetricGraph {
    SymmetricGraph {
        swap: swap(marked),
        graph: unmarked(marked),
        automorphisms: canonical(marked).automorphisms,
    }
}
