//! Giving up early: which partly chosen mechanisms already let an output loose.
//!
//! Every option contains the present joint's motion, so the motions of the kept links can only grow from what they are
//! when all joints still to be chosen stay as they are. That least space is computed for each node; where it exceeds
//! the present motion, no completion is admissible. After the last joint the same test is the condition itself.

use crate::geom::exact::ExactField;
use crate::linalg::echelon::{Echelon, relations, transpose};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use std::collections::BTreeMap;

/// The test for the nodes of one layer: rows of a node, carried by `map`, span a space with `base` + (dimensions past
/// the first `locks` coordinates) kept motions.
#[derive(Debug, Clone)]
pub struct Lookahead {
    /// For each coordinate of a node, its image.
    pub map: Vec<Vec<Residue>>,
    /// Coordinates that must vanish for a motion to be possible.
    pub locks: usize,
    /// Kept motions that do not depend on the node.
    pub base: usize,
    /// Kept motions allowed.
    pub allowed: usize,
}

/// What the coordinates of a node are of, as in [`crate::search::diagram::frontier::Step`].
#[derive(Clone, Copy)]
pub(crate) struct NodeParts<'a> {
    /// The live links as (root, link).
    pub(crate) live: &'a [(LinkId, LinkId)],
    /// The pending couplings, which come after them.
    pub(crate) pending: &'a [usize],
}

/// Makes the test for nodes with some parts, when the joints `left`, with their present spans, are still to come.
#[must_use]
pub(crate) fn lookahead(
    exact: &ExactField,
    mechanism: &Mechanism,
    dim: usize,
    NodeParts { live, pending }: NodeParts<'_>,
    left: &[(JointId, Vec<Vec<Residue>>)],
    kept: &[LinkId],
    allowed: usize,
) -> Lookahead {
    let f = exact.field();
    let frame = mechanism.frame();
    // Components of outer links, root first: those of the node, and single links it does not have yet.
    let mut components: Vec<Vec<LinkId>> = Vec::new();
    for &(root, link) in live {
        match components.iter_mut().find(|c| c[0] == root) {
            Some(c) => c.push(link),
            None => components.push(vec![root, link]),
        }
    }
    let single = |l: LinkId, components: &mut Vec<Vec<LinkId>>| {
        if !components.iter().any(|c| c.contains(&l)) {
            components.push(vec![l]);
        }
    };
    kept.iter()
        .chain([&frame])
        .for_each(|&l| single(l, &mut components));
    let outer: Vec<LinkId> = components
        .iter()
        .flatten()
        .copied()
        .filter(|&l| l != frame)
        .collect();
    let mut inner: Vec<LinkId> = left
        .iter()
        .flat_map(|(j, _)| mechanism.joints[*j].links)
        .collect();
    inner.retain(|l| !outer.contains(l) && *l != frame);
    inner.sort_unstable();
    inner.dedup();
    let mut unmet: Vec<usize> = left
        .iter()
        .flat_map(|(j, _)| mechanism.couplings_of(*j).map(|(q, _)| q))
        .filter(|q| !pending.contains(q))
        .collect();
    unmet.sort_unstable();
    unmet.dedup();
    // Inner links and couplings first, so that elimination leaves constraints on outer ones alone at the end.
    let first = inner.len() * dim + unmet.len();
    let inner_places = inner.iter().enumerate().map(|(i, &l)| (l, i * dim));
    let outer_places = outer.iter().enumerate().map(|(i, &l)| (l, first + i * dim));
    let place: BTreeMap<LinkId, usize> = inner_places.chain(outer_places).collect();
    let unmet_at = |q: usize| Some(inner.len() * dim + unmet.iter().position(|&x| x == q)?);
    let pending_at =
        |q: usize| Some(first + outer.len() * dim + pending.iter().position(|&x| x == q)?);
    let width = first + outer.len() * dim + pending.len();
    let mut constraints = Echelon::new(f);
    for (j, span) in left {
        let [u, v] = mechanism.joints[*j].links;
        let annihilator = if span.is_empty() {
            (0..dim)
                .map(|c| (0..dim).map(|i| if i == c { f.one() } else { 0 }).collect())
                .collect()
        } else {
            relations(f, &transpose(span))
        };
        for wrench in annihilator {
            let mut row = vec![0; width];
            for (link, plus) in [(u, false), (v, true)] {
                if let Some(&at) = place.get(&link) {
                    f.accumulate(&mut row[at..at + dim], &wrench[..dim], plus);
                }
            }
            // The entries of a coupling's two joints are opposite: that of a joint to come is less what is pending, or less
            // that of the other joint to come.
            for (i, (q, end)) in mechanism.couplings_of(*j).enumerate() {
                let plus = !pending.contains(&q) && end == 0;
                if let Some(at) = pending_at(q).or_else(|| unmet_at(q)) {
                    f.accumulate(&mut row[at..=at], &wrench[dim + i..=dim + i], plus);
                }
            }
            constraints.insert(&row);
        }
    }
    let locks: Vec<Vec<Residue>> = constraints
        .reduced()
        .into_iter()
        .filter(|r| r[..first].iter().all(|&x| x == 0))
        .collect();
    // Image of "these links move with unit component c": the locks it meets, then the kept links' twists.
    let image = |links: &[(LinkId, bool)], c: usize| {
        let mut out = vec![0; locks.len() + kept.len() * dim];
        for &(l, plus) in links {
            let Some(&at) = place.get(&l) else { continue };
            for (o, lock) in out.iter_mut().zip(&locks) {
                *o = if plus {
                    f.add(*o, lock[at + c])
                } else {
                    f.sub(*o, lock[at + c])
                };
            }
            for (k, _) in kept.iter().enumerate().filter(|(_, k)| **k == l) {
                let o = &mut out[locks.len() + k * dim + c];
                *o = if plus {
                    f.add(*o, f.one())
                } else {
                    f.sub(*o, f.one())
                };
            }
        }
        out
    };
    // Whole components move freely unless they hold the frame.
    let mut free = Echelon::new(f);
    for component in components.iter().filter(|c| !c.contains(&frame)) {
        let together: Vec<(LinkId, bool)> = component.iter().map(|&l| (l, true)).collect();
        (0..dim).for_each(|c| {
            free.insert(&image(&together, c));
        });
    }
    let taken = free.pivots();
    let total = locks.len() + kept.len() * dim;
    let open: Vec<usize> = (0..total).filter(|i| !taken.contains(i)).collect();
    let mut map = Vec::new();
    for &(root, link) in live {
        let component = components
            .iter()
            .find(|c| c[0] == root)
            .expect("live links are in components");
        let mut moved = vec![(link, true)];
        if link == frame {
            // Coordinates are relative to the root; the frame itself rests.
            moved.extend(component.iter().map(|&l| (l, false)));
        }
        for c in 0..dim {
            let mut v = image(&moved, c);
            free.reduce(&mut v);
            map.push(open.iter().map(|&i| v[i]).collect());
        }
    }
    for &q in pending {
        // A unit of the rate: the locks it meets; the rest of its block is zeros.
        for c in 0..dim {
            let mut v = vec![0; total];
            if let Some(at) = pending_at(q).filter(|_| c == 0) {
                v.iter_mut().zip(&locks).for_each(|(o, lock)| *o = lock[at]);
            }
            free.reduce(&mut v);
            map.push(open.iter().map(|&i| v[i]).collect());
        }
    }
    Lookahead {
        map,
        locks: open.iter().filter(|&&i| i < locks.len()).count(),
        base: taken.iter().filter(|&&i| i >= locks.len()).count(),
        allowed,
    }
}

#[cfg(test)]
mod tests {
    use crate::model::coupling::{CoupledFreedom, Coupling};
    use crate::model::drawn::{drawn, hinges};
    use crate::model::joint_type::Freedom;
    use crate::model::mechanism::{JointId, Mechanism};
    use crate::rank::exact::field::exact_field;
    use crate::search::question::Question;
    use crate::search::question::conditions::Conditions;
    use crate::search::testing::in_both_spaces;
    use itertools::Itertools;

    /// How many ends the diagrams of determinate and of admissible variants have that are made of motions of links.
    fn ends(m: &Mechanism, max_redundant: u32) -> Vec<usize> {
        let conditions = Conditions {
            max_redundant,
            ..Conditions::default()
        };
        let question = Question::new(exact_field(m, 0).unwrap(), m, conditions).unwrap();
        let found = in_both_spaces(&question).into_iter();
        found
            .map(|[live, _]| live.map_or(0, |d| d.terminals.len()))
            .collect()
    }

    /// Cranks of a parallelogram turn alike: gears that make them do so are redundant, and others stop them. Either way it keeps the
    /// motion that it has, whichever crank a coupling names first and whichever link a hinge does.
    #[test]
    fn coupled_cranks_keep_the_motion_that_they_have() {
        let at = |x: f64, y: f64| [x, y, 0.0];
        let joints = [
            ([0, 1], at(0.0, 0.0)),
            ([1, 2], at(1.0, 4.0)),
            ([2, 3], at(7.0, 4.0)),
            ([0, 3], at(6.0, 0.0)),
        ];
        for ((ratio, redundant), order) in [(1, 4), (-1, 3)]
            .into_iter()
            .cartesian_product([0, 1, 2, 3].into_iter().permutations(4))
        {
            let taken = order.iter().map(|&i: &usize| joints[i]).collect_vec();
            let mut m = drawn(&hinges(&taken), &[2]);
            let place = |j: usize| order.iter().position(|&i| i == j).unwrap();
            for first in [[0, 3], [3, 0]] {
                let end = |j: usize| CoupledFreedom {
                    joint: JointId::new(place(j)),
                    freedom: Freedom::Rz,
                };
                m.couplings = vec![Coupling {
                    ends: first.map(end),
                    ratio: ratio.into(),
                    gear: true,
                }];
                let found = [redundant, redundant - 1].map(|most| ends(&m, most));
                assert_eq!(found, [[1, 1], [0, 0]], "{ratio} {order:?} {first:?}");
            }
        }
    }
}
