//! The nodes of both halves that complete each other, by the space that they span in contours and the motion of kept links.
//!
//! Nodes span few different spaces in the coordinates of contours; many differ only in how kept links move. So each pair of spaces is
//! examined once: together they must span all coordinates. Their intersection closes every contour twice, once from each half, and kept
//! links must move in the same way with it. A number identifies that motion, and nodes with the same number complete each other. Nodes are
//! therefore looked up, and not compared in pairs.

use crate::linalg::echelon::{linear_combination, linear_relations};
use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::node_sets::{Numbered, Set, add_node, empty_set};
use crate::search::diagram::{DEAD, ShouldCancel};
use hashbrown::HashMap;
use rayon::prelude::*;

/// The motion of kept links with the intersection of two spaces is identified by a sum over a basis, weighted by powers of this number. The
/// coordinates of kept links are weighted by powers of another number.
const WEIGHT: i64 = 0x2545_f491_4f6c_dd1d;
/// Number of groups between two checks for cancellation.
const BATCH: usize = 16;
/// Number of lookups that take about as long as one intersection of two spaces.
const LOOKUPS: usize = 200;

/// The nodes that span the same space of contours.
pub(super) struct Alike {
    /// A basis of the space in reduced form, and its pivots.
    rows: Vec<Vec<Residue>>,
    pivots: Vec<usize>,
    /// The nodes, each with the motion of kept links for each row.
    nodes: Vec<(usize, Vec<Residue>)>,
}

/// Nodes of one half by the space of contours that they span.
#[derive(Default)]
pub(super) struct Grouped {
    known: HashMap<Vec<Vec<Residue>>, usize>,
    groups: Vec<Alike>,
    nodes: usize,
}

impl Grouped {
    /// Collects nodes by their rows in reduced form, which have the motion of kept links as the last number. A node that moves
    /// these and closes every contour has no completion.
    pub(super) fn group_nodes(nodes: impl Iterator<Item = Vec<Vec<Residue>>>) -> Grouped {
        let mut grouped = Grouped::default();
        nodes.for_each(|rows| grouped.take_node(rows));
        grouped
    }

    fn take_node(&mut self, mut rows: Vec<Vec<Residue>>) {
        let node = self.nodes;
        self.nodes += 1;
        let moved: Vec<Residue> = rows.iter_mut().filter_map(Vec::pop).collect();
        let pivot = |row: &Vec<Residue>| row.iter().position(|&x| x != 0);
        let Some(pivots) = rows.iter().map(pivot).collect() else {
            return;
        };
        let group = *self.known.entry(rows).or_insert_with_key(|rows| {
            self.groups.push(Alike {
                rows: rows.clone(),
                pivots,
                nodes: Vec::new(),
            });
            self.groups.len() - 1
        });
        self.groups[group].nodes.push((node, moved));
    }
}

/// Returns how many lookups it takes to match two halves.
pub(super) fn count_lookups(front: &Grouped, back: &Grouped) -> usize {
    let (a, b) = (front.groups.len(), back.groups.len());
    a * b * LOOKUPS + front.nodes * b + back.nodes * a
}

/// Returns for each node of the front the set of nodes of the back that complete it. `None` if the sets take more than the
/// given bytes, or if cancelled.
///
/// # Complexity
/// O(a·b·w³ + (n·b + m·a)·w) field operations for n nodes of the front in a groups, m of the back in b, and w coordinates.
pub(super) fn match_halves(
    field: Field,
    width: usize,
    [front, back]: &[Grouped; 2],
    bytes: usize,
    cancelled: ShouldCancel<'_>,
) -> Option<(Vec<u32>, Vec<Set>)> {
    let mut of_node = vec![DEAD; front.nodes];
    let mut numbered = Numbered::default();
    for some in front.groups.chunks(BATCH) {
        if cancelled() {
            return None;
        }
        let completed = |group| group_completions(field, width, group, back);
        let found: Vec<Completed> = some.par_iter().map(completed).collect();
        for (set, nodes) in found.into_iter().flatten() {
            let number = numbered.number_of(set);
            nodes.iter().for_each(|&node| of_node[node] = number);
        }
        if numbered.all.len() * back.nodes / 8 > bytes {
            return None;
        }
    }
    Some((of_node, numbered.all))
}

/// Sets of nodes of the back, each with the nodes of the front that it completes.
type Completed = Vec<(Set, Vec<usize>)>;

/// Returns the sets that complete the nodes of a group, each set once.
fn group_completions(field: Field, width: usize, group: &Alike, back: &Grouped) -> Completed {
    // Nodes of the back that move kept links alike with what they have in common with the group, where a node of it does so, too.
    let mut alike: Vec<Vec<usize>> = Vec::new();
    let mut of_node: Vec<Vec<usize>> = vec![Vec::new(); group.nodes.len()];
    let mut numbers: Vec<(Residue, usize)> = Vec::new();
    let mut known: HashMap<Residue, Option<usize>> = HashMap::new();
    for others in &back.groups {
        let Some(common) = find_intersection(field, width, group, others) else {
            continue;
        };
        let of_others = others.nodes.iter();
        numbers.clear();
        numbers.extend(of_others.map(|(node, moved)| (field.dot(&common.back, moved), *node)));
        numbers.sort_unstable();
        known.clear();
        for (found, (_, moved)) in of_node.iter_mut().zip(&group.nodes) {
            let number = field.dot(&common.front, moved);
            let matching = known.entry(number).or_insert_with(|| {
                let from = &numbers[numbers.partition_point(|(n, _)| *n < number)..];
                let same = &from[..from.partition_point(|(n, _)| *n == number)];
                (!same.is_empty()).then(|| {
                    alike.push(same.iter().map(|(_, node)| *node).collect());
                    alike.len() - 1
                })
            });
            found.extend(*matching);
        }
    }
    let mut nodes: HashMap<Vec<usize>, Vec<usize>> = HashMap::new();
    let mut different = Vec::new();
    for (found, (node, _)) in of_node.into_iter().zip(&group.nodes) {
        let same = nodes.entry(found).or_insert_with_key(|found| {
            different.push(found.clone());
            Vec::new()
        });
        same.push(*node);
    }
    let of = |found: Vec<usize>| {
        let mut set = empty_set(back.nodes);
        let completing = found.iter().flat_map(|&number| &alike[number]);
        completing.for_each(|&node| add_node(&mut set, node));
        (set, nodes.remove(&found).unwrap_or_default())
    };
    different.into_iter().map(of).collect()
}

/// The intersection of the spaces of two groups: the weighted sum of a basis, as factors of the rows of each group.
struct Common {
    front: Vec<Residue>,
    back: Vec<Residue>,
}

/// Returns the intersection of two groups; `None` if they do not span all coordinates together.
fn find_intersection(field: Field, width: usize, front: &Alike, back: &Alike) -> Option<Common> {
    let missing = width - front.rows.len();
    if back.rows.len() < missing {
        return None;
    }
    let at_pivots =
        |row: &Vec<Residue>| -> Vec<Residue> { front.pivots.iter().map(|&p| row[p]).collect() };
    let within: Vec<Vec<Residue>> = back.rows.iter().map(at_pivots).collect();
    let beside = back.rows.iter().map(|row| {
        let mut row = row.clone();
        for (own, &pivot) in front.rows.iter().zip(&front.pivots) {
            field.subtract_multiple(&mut row[pivot..], &own[pivot..]);
        }
        row
    });
    let beside: Vec<Vec<Residue>> = beside.collect();
    let same = linear_relations(field, &beside);
    if back.rows.len() - same.len() < missing {
        return None;
    }
    let weight = field.from_i64(WEIGHT);
    let weights: Vec<Residue> = (0..same.len())
        .map(|i| field.pow(weight, i as u64))
        .collect();
    let mut sum = linear_combination(field, &same, &weights);
    sum.resize(back.rows.len(), 0);
    let mut factors = linear_combination(field, &within, &sum);
    factors.resize(front.rows.len(), 0);
    Some(Common {
        front: factors,
        back: sum,
    })
}
