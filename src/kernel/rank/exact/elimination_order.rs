//! The elimination order of the contours, fewest neighbours first, and the composition of each front.

use crate::closure::{Closure, Column};
use crate::linalg::modp::Residue;
use crate::model::mechanism::JointId;
use fixedbitset::FixedBitSet;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Number of contours up to which a linear scan is faster than a heap.
const FEW: usize = 12;

/// Plan of the elimination, made before any arithmetic. A coupling takes part as one more contour, whose rows are zero
/// except for the first.
pub(in crate::rank) struct EliminationPlan {
    /// Start and end of the columns of each joint.
    columns_of: Vec<(usize, usize)>,
    /// Start of the contours of each joint in `passes`, with one more entry at the end.
    passes_from: Vec<usize>,
    /// The contours of each joint, with the direction in which they pass it.
    passes: Vec<(usize, bool)>,
    /// The contours in elimination order.
    pub(in crate::rank) order: Vec<usize>,
    /// For each contour, a number that increases along the order.
    pub(in crate::rank) place: Vec<usize>,
    /// For each contour, the other contours that have rows in its front.
    pub(in crate::rank) neighbours: Vec<FixedBitSet>,
}

impl EliminationPlan {
    pub(in crate::rank) fn new(closure: &Closure<Residue>) -> EliminationPlan {
        let (k, joints) = (
            closure.contours.len() + closure.couplings.len(),
            closure.columns.last().map_or(0, |c| c.joint.index() + 1),
        );
        // Joints without columns (rigid ones) link no contours.
        let mut columns_of = vec![(0, 0); joints];
        for (i, c) in closure.columns.iter().enumerate() {
            let range = &mut columns_of[c.joint];
            if range.1 == 0 {
                range.0 = i;
            }
            range.1 = i + 1;
        }
        let with_columns = |j: JointId| columns_of.get(j.index()).is_some_and(|r| r.1 > 0);
        let incidences = || {
            let contours = closure.contours.iter().enumerate();
            let couplings = (closure.contours.len()..).zip(&closure.couplings);
            contours
                .flat_map(|(i, c)| c.joints.iter().map(move |&(j, forward)| (i, j, forward)))
                .filter(|&(_, j, _)| with_columns(j))
                .chain(couplings.flat_map(|(i, c)| {
                    c.entries
                        .each_ref()
                        .map(|(at, _)| (i, closure.columns[*at].joint, true))
                }))
        };
        let mut passes_from = vec![0; joints + 1];
        for (_, j, _) in incidences() {
            passes_from[j.index() + 1] += 1;
        }
        for j in 0..joints {
            passes_from[j + 1] += passes_from[j];
        }
        let mut passes = vec![(0, true); passes_from[joints]];
        for (i, j, forward) in incidences() {
            // The starts move to the ends here, and back below.
            passes[passes_from[j]] = (i, forward);
            passes_from[j] += 1;
        }
        passes_from.rotate_right(1);
        passes_from[0] = 0;
        let mut neighbours = vec![FixedBitSet::with_capacity(k); k];
        for j in 0..joints {
            let of = &passes[passes_from[j]..passes_from[j + 1]];
            for &(a, _) in of {
                for &(b, _) in of.iter().filter(|(b, _)| *b != a) {
                    neighbours[a].insert(b);
                }
            }
        }
        let (order, place) = fewest_neighbours_first(k, &mut neighbours);
        EliminationPlan {
            columns_of,
            passes_from,
            passes,
            order,
            place,
            neighbours,
        }
    }

    pub(in crate::rank) fn contours_through(&self, joint: JointId) -> &[(usize, bool)] {
        match self.passes_from.get(joint.index()..joint.index() + 2) {
            Some(range) => &self.passes[range[0]..range[1]],
            None => &[],
        }
    }

    pub(in crate::rank) fn columns_of_joint<'a>(
        &self,
        closure: &'a Closure<Residue>,
        joint: JointId,
    ) -> impl Iterator<Item = (usize, &'a Column<Residue>)> {
        let (from, to) = self.columns_of[joint];
        (from..).zip(&closure.columns[from..to])
    }
}

/// Returns the elimination order, and for each contour a number that increases along it. Each set is reduced to the
/// neighbours that the contour has when it is eliminated.
fn fewest_neighbours_first(k: usize, neighbours: &mut [FixedBitSet]) -> (Vec<usize>, Vec<usize>) {
    // Greater than any degree.
    const DONE: usize = usize::MAX / 2;
    let mut degree: Vec<usize> = neighbours.iter().map(|n| n.count_ones(..)).collect();
    let mut order = Vec::with_capacity(k);
    let mut heap = BinaryHeap::new();
    if k > FEW {
        heap.extend(degree.iter().enumerate().map(|(c, &d)| Reverse((d, c))));
    }
    while order.len() < k {
        let c = if k > FEW {
            match heap.pop() {
                Some(Reverse((d, c))) if degree[c] == d => c,
                _ => continue,
            }
        } else {
            (0..k).min_by_key(|&c| degree[c]).unwrap_or(0)
        };
        degree[c] = DONE + order.len();
        order.push(c);
        let near = neighbours[c].clone();
        for n in near.ones() {
            neighbours[n].union_with(&near);
            neighbours[n].set(n, false);
            neighbours[n].set(c, false);
            let now = neighbours[n].count_ones(..);
            if now != degree[n] {
                degree[n] = now;
                if k > FEW {
                    heap.push(Reverse((now, n)));
                }
            }
        }
    }
    (order, degree)
}
