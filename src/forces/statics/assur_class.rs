//! Class, order and kind of an Assur group.

use crate::statics::planar::{BodyId, PairId, PairKind, PlanarMechanism};
use petgraph::algo::dijkstra;
use petgraph::graph::{EdgeReference, NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;
use std::fmt;

/// The structural kind of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// One body with only rigid or doubled pairs.
    Single,
    /// Two bodies, with its species 1 to 5 (RRR, RRP, RPR, PRP, RPP), 6 for PPP, which is not determinate.
    Dyad(u8),
    /// A body with three pairs and a leash on each.
    Triad,
    /// Two bodies with three pairs and two with two between them, in a closed contour: `[Bychkov, Dvornikov & Zhukov
    /// 2018]`.
    FourLinkContour,
    /// Anything else.
    Other,
}

/// Class, order and kind of a group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AssurClass {
    /// The largest number of pairs around one contour of the group: a body with k pairs is a rigid contour of k, bodies
    /// joined in a ring a changeable one; at least 2.
    pub class: usize,
    /// Number of outer pairs.
    pub order: usize,
    /// Numbers of bodies with two, three, four, ... pairs.
    pub composition: Vec<usize>,
    /// Independent closed contours of the group.
    pub contours: usize,
    /// The structural kind.
    pub kind: Kind,
}

/// Returns a class in Roman numerals, as is usual in the field.
///
/// # Examples
/// ```
/// use ozols::statics::assur_class::roman_numeral;
/// assert_eq!(roman_numeral(4), "IV");
/// ```
#[must_use]
pub fn roman_numeral(class: usize) -> String {
    const ROMAN: [&str; 13] = [
        "0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII",
    ];
    ROMAN
        .get(class)
        .map_or_else(|| class.to_string(), |r| (*r).to_owned())
}

impl fmt::Display for AssurClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "class {}, order {}",
            roman_numeral(self.class),
            self.order
        )?;
        match self.kind {
            Kind::Dyad(species) => {
                const NAMES: [&str; 6] = ["RRR", "RRP", "RPR", "PRP", "RPP", "PPP"];
                let name = NAMES.get(usize::from(species).wrapping_sub(1));
                write!(f, ", dyad {}", name.unwrap_or(&"?"))
            }
            Kind::Triad => f.write_str(", triad"),
            Kind::FourLinkContour => f.write_str(", four links in a closed contour"),
            Kind::Single | Kind::Other => Ok(()),
        }
    }
}

/// Classifies a group by Assur and Artobolevsky: the class is that of its highest contour, the order its number of
/// outer pairs. Changeable contours are those of a shortest basis.
///
/// # Complexity
/// O(n·p²) for n bodies and p pairs of the group.
///
/// # Sources
/// I. I. Artobolevsky, "Theory of Mechanisms and Machines", 4th ed., 1988.
#[must_use]
pub(crate) fn classify_group(
    m: &PlanarMechanism,
    blocks: &[Vec<BodyId>],
    inner: &[PairId],
    outer: &[PairId],
) -> AssurClass {
    let block = |body: BodyId| blocks.iter().position(|b| b.contains(&body));
    let mut degree = vec![0usize; blocks.len()];
    let mut edges = Vec::new();
    for &p in inner.iter().chain(outer) {
        let ends = m.pairs[p].bodies.map(block);
        for b in ends.into_iter().flatten() {
            degree[b] += 1;
        }
        if let [Some(a), Some(b)] = ends {
            edges.push((a, b));
        }
    }
    let changeable = longest_contour(blocks.len(), &edges);
    let rigid = degree.iter().copied().max().unwrap_or(0);
    let mut composition: Vec<usize> = Vec::new();
    for &d in &degree {
        let place = d.saturating_sub(2);
        composition.resize(composition.len().max(place + 1), 0);
        composition[place] += 1;
    }
    AssurClass {
        class: rigid.max(changeable).max(2),
        order: outer.len(),
        composition,
        contours: (edges.len() + 1).saturating_sub(blocks.len()),
        kind: group_kind(m, blocks, inner, outer, &degree, &edges),
    }
}

fn group_kind(
    m: &PlanarMechanism,
    blocks: &[Vec<BodyId>],
    inner: &[PairId],
    outer: &[PairId],
    degree: &[usize],
    edges: &[(usize, usize)],
) -> Kind {
    let with = |d: usize| degree.iter().filter(|&&x| x == d).count();
    match (blocks.len(), inner.len(), outer.len()) {
        (1, _, _) => Kind::Single,
        (2, 1, 2) => {
            let slides = |p: &PairId| m.pairs[*p].kind == PairKind::Sliding;
            let species = match (
                outer.iter().filter(|p| slides(p)).count(),
                slides(&inner[0]),
            ) {
                (0, false) => 1,
                (1, false) => 2,
                (0, true) => 3,
                (2, false) => 4,
                (1, true) => 5,
                _ => 6,
            };
            Kind::Dyad(species)
        }
        (4, 3, 3) if with(3) == 1 && with(2) == 3 => Kind::Triad,
        (4, 4, 2) if with(3) == 2 && with(2) == 2 => {
            // Each inner pair joins a body of three to a body of two, and no two bodies are joined twice.
            let mixed = edges.iter().all(|&(a, b)| degree[a] != degree[b]);
            let key = |&(a, b): &(usize, usize)| (a.min(b), a.max(b));
            let mut sorted: Vec<_> = edges.iter().map(key).collect();
            sorted.sort_unstable();
            sorted.dedup();
            if mixed && sorted.len() == 4 {
                Kind::FourLinkContour
            } else {
                Kind::Other
            }
        }
        _ => Kind::Other,
    }
}

/// Returns the length of the longest contour of a shortest basis, or 0 if there is none. It is greedy: each edge is
/// closed by a shortest path.
fn longest_contour(n: usize, edges: &[(usize, usize)]) -> usize {
    let mut graph: UnGraph<(), usize> = UnGraph::default();
    (0..n).for_each(|_| {
        graph.add_node(());
    });
    for (i, &(a, b)) in edges.iter().enumerate() {
        graph.add_edge(NodeIndex::new(a), NodeIndex::new(b), i);
    }
    let mut candidates = basis_candidates(&graph);
    candidates.sort_unstable();
    candidates.dedup();
    let mut basis: Vec<Vec<usize>> = Vec::new();
    let mut longest = 0;
    for (length, mut row) in candidates {
        for b in &basis {
            if row.binary_search(&b[0]).is_ok() {
                row = symmetric_difference(&row, b);
            }
        }
        if !row.is_empty() {
            longest = longest.max(length);
            basis.push(row);
        }
    }
    longest
}

/// Returns Horton's candidates for a shortest basis, each with its length: for every body and pair, the two shortest
/// paths to the pair's ends, and the pair.
fn basis_candidates(graph: &UnGraph<(), usize>) -> Vec<(usize, Vec<usize>)> {
    let mut out: Vec<(usize, Vec<usize>)> = Vec::new();
    for v in graph.node_indices() {
        let far = dijkstra(graph, v, None, |_| 1usize);
        for e in graph.edge_references() {
            if !far.contains_key(&e.source()) {
                continue;
            }
            let path = |x| shortest_path(graph, |n| far.get(&n).copied(), x);
            let (a, b) = (path(e.source()), path(e.target()));
            if a.iter().any(|x| b.contains(x)) || a.contains(e.weight()) || b.contains(e.weight()) {
                continue;
            }
            let mut all: Vec<usize> = a.into_iter().chain(b).chain([*e.weight()]).collect();
            all.sort_unstable();
            out.push((all.len(), all));
        }
    }
    out
}

/// Returns the edges of a shortest path from `x` back to the body from which distances are measured.
fn shortest_path(
    graph: &UnGraph<(), usize>,
    far: impl Fn(NodeIndex) -> Option<usize>,
    mut x: NodeIndex,
) -> Vec<usize> {
    let mut out = Vec::new();
    while far(x) != Some(0) {
        let other = |e: &EdgeReference<'_, usize>| {
            if e.source() == x {
                e.target()
            } else {
                e.source()
            }
        };
        let nearer = |e: &EdgeReference<'_, usize>| {
            let d = far(other(e));
            d.is_some_and(|d| Some(d + 1) == far(x))
        };
        let Some(e) = graph.edges(x).find(nearer) else {
            break;
        };
        out.push(*e.weight());
        x = other(&e);
    }
    out
}

fn symmetric_difference(a: &[usize], b: &[usize]) -> Vec<usize> {
    let only = |x: &[usize], y: &[usize]| {
        let keep = x.iter().filter(|e| y.binary_search(e).is_err());
        keep.copied().collect::<Vec<_>>()
    };
    let mut out = only(a, b);
    out.extend(only(b, a));
    out.sort_unstable();
    out
}
