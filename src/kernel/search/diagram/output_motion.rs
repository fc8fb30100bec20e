//! Giving up early: which partly chosen mechanisms already let an output loose.
//!
//! Every option contains the present joint's motion, so the motions of the kept links can only grow from what they are
//! when all joints still to be chosen stay as they are. That least space is computed for each node; where it exceeds
//! the present motion, no completion is admissible. After the last joint the same test is the condition itself.

use crate::geom::exact::ExactField;
use crate::linalg::echelon::{Echelon, relations, transpose};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::search::diagram::frontier::components;
use std::collections::BTreeMap;

/// The test for the nodes of one layer: rows of a node, carried by `map`, span a space with `base` + (dimensions past
/// the first `locks` coordinates) kept motions.
#[derive(Debug, Clone)]
pub(crate) struct Lookahead {
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
    let (field, frame) = (exact.field(), mechanism.frame());
    // Components of outer links, root first: those of the node, and single links it does not have yet.
    let mut components = components(live);
    for &l in kept.iter().chain([&frame]) {
        if !components.iter().any(|c| c.contains(&l)) {
            components.push(vec![l]);
        }
    }
    let places = RowPlaces::new(mechanism, dim, &components, left, pending);
    let locks = locks(field, mechanism, left, &places);
    let images = LinkImages {
        field,
        places: &places,
        locks: &locks,
        kept,
        links: mechanism.links.len(),
    };
    let free = images.free(&components, frame);
    let (taken, total) = (free.pivots(), images.width());
    let open: Vec<usize> = (0..total).filter(|i| !taken.contains(i)).collect();
    let seen = |mut v: Vec<Residue>| -> Vec<Residue> {
        free.reduce(&mut v);
        open.iter().map(|&i| v[i]).collect()
    };
    let mut map = Vec::new();
    for &(root, link) in live {
        let mut of_root = components.iter().filter(|c| c[0] == root);
        let component = of_root.next().expect("live links are in components");
        let mut moved = vec![(link, true)];
        if link == frame {
            // Coordinates are relative to the root; the frame itself rests.
            moved.extend(component.iter().map(|&l| (l, false)));
        }
        map.extend((0..dim).map(|c| seen(images.image(&moved, c))));
    }
    for &q in pending {
        // A unit of the rate: the locks it meets; the rest of its block is zeros.
        for c in 0..dim {
            let mut v = vec![0; total];
            if let Some(at) = places.pending(q).filter(|_| c == 0) {
                v.iter_mut().zip(&locks).for_each(|(o, lock)| *o = lock[at]);
            }
            map.push(seen(v));
        }
    }
    let bound = open.partition_point(|&i| i < locks.len());
    let (map, locks_left) = independent(field, map, bound);
    Lookahead {
        map,
        locks: locks_left,
        base: taken.iter().filter(|&&i| i >= locks.len()).count(),
        allowed,
    }
}

/// The coordinates of some images that are no combinations of those before them, and how many of the first ones these are: joints
/// far ahead bind in as many ways as there are of them, and a node has a few numbers.
fn independent(
    field: Field,
    images: Vec<Vec<Residue>>,
    first: usize,
) -> (Vec<Vec<Residue>>, usize) {
    let mut span = Echelon::new(field);
    let columns = transpose(&images);
    let kept: Vec<usize> = (0..columns.len())
        .filter(|&c| span.rank() < images.len() && span.insert(&columns[c]))
        .collect();
    let picked = |image: Vec<Residue>| kept.iter().map(|&c| image[c]).collect();
    let first = kept.partition_point(|&c| c < first);
    (images.into_iter().map(picked).collect(), first)
}

/// Where the links and couplings that constraints are about stand in a row of them: inner ones first, so that elimination leaves
/// constraints on outer ones alone at the end.
struct RowPlaces<'a> {
    dim: usize,
    /// Links but for the frame: those between joints to come alone, and then the outer ones.
    links: BTreeMap<LinkId, usize>,
    /// Couplings of joints to come alone, behind the inner links.
    unmet: Vec<usize>,
    unmet_from: usize,
    /// Couplings behind the outer links.
    pending: &'a [usize],
    pending_from: usize,
}

impl<'a> RowPlaces<'a> {
    /// For components of outer links and the joints to come.
    fn new(
        mechanism: &Mechanism,
        dim: usize,
        components: &[Vec<LinkId>],
        left: &[(JointId, Vec<Vec<Residue>>)],
        pending: &'a [usize],
    ) -> RowPlaces<'a> {
        let frame = mechanism.frame();
        let outer = components.iter().flatten().copied();
        let outer: Vec<LinkId> = outer.filter(|&l| l != frame).collect();
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
        let unmet_from = inner.len() * dim;
        let first = unmet_from + unmet.len();
        let inner_places = inner.iter().enumerate().map(|(i, &l)| (l, i * dim));
        let outer_places = outer.iter().enumerate().map(|(i, &l)| (l, first + i * dim));
        RowPlaces {
            dim,
            links: inner_places.chain(outer_places).collect(),
            unmet,
            unmet_from,
            pending,
            pending_from: first + outer.len() * dim,
        }
    }

    /// Where the outer links begin.
    fn first(&self) -> usize {
        self.unmet_from + self.unmet.len()
    }

    fn width(&self) -> usize {
        self.pending_from + self.pending.len()
    }

    /// The place of a coupling of joints to come alone.
    fn unmet(&self, q: usize) -> Option<usize> {
        Some(self.unmet_from + self.unmet.iter().position(|&x| x == q)?)
    }

    /// The place of a pending coupling.
    fn pending(&self, q: usize) -> Option<usize> {
        Some(self.pending_from + self.pending.iter().position(|&x| x == q)?)
    }
}

/// What the joints to come ask of outer links and pending couplings, whatever inner ones do.
fn locks(
    f: Field,
    mechanism: &Mechanism,
    left: &[(JointId, Vec<Vec<Residue>>)],
    places: &RowPlaces<'_>,
) -> Vec<Vec<Residue>> {
    let (dim, pending, first) = (places.dim, places.pending, places.first());
    let mut constraints = Echelon::new(f);
    for (j, span) in left {
        let [u, v] = mechanism.joints[*j].links;
        for wrench in annihilator(f, dim + mechanism.rates_of(*j), span) {
            let mut row = vec![0; places.width()];
            for (link, plus) in [(u, false), (v, true)] {
                if let Some(&at) = places.links.get(&link) {
                    f.accumulate(&mut row[at..at + dim], &wrench[..dim], plus);
                }
            }
            if let Some(drive) = mechanism.kept_drive(*j)
                && let Some(&at) = places.links.get(&mechanism.drive_link(drive))
            {
                let rate = wrench[wrench.len() - 1];
                f.accumulate(&mut row[at..=at], &[rate], true);
            }
            // The entries of a coupling's two joints are opposite: that of a joint to come is less what is pending, or less
            // that of the other joint to come.
            for (i, (q, end)) in mechanism.couplings_of(*j).enumerate() {
                let plus = !pending.contains(&q) && end == 0;
                if let Some(at) = places.pending(q).or_else(|| places.unmet(q)) {
                    f.accumulate(&mut row[at..=at], &wrench[dim + i..=dim + i], plus);
                }
            }
            constraints.insert(&row);
        }
    }
    constraints
        .reduced()
        .into_iter()
        .filter(|r| r[..first].iter().all(|&x| x == 0))
        .collect()
}

/// What a joint with a span of vectors of a width bears: all forces and moments where it has no freedom, and its rates rest.
fn annihilator(f: Field, width: usize, span: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
    if span.is_empty() {
        let unit = |c| {
            (0..width)
                .map(|i| if i == c { f.one() } else { 0 })
                .collect()
        };
        (0..width).map(unit).collect()
    } else {
        relations(f, &transpose(span))
    }
}

/// What becomes of motions of links: the locks they meet, then the kept links' twists.
struct LinkImages<'a> {
    field: Field,
    places: &'a RowPlaces<'a>,
    locks: &'a [Vec<Residue>],
    kept: &'a [LinkId],
    /// How many links the mechanism has; those of higher numbers stand for drives.
    links: usize,
}

impl LinkImages<'_> {
    fn width(&self) -> usize {
        self.locks.len() + self.kept.len() * self.places.dim
    }

    /// Image of "these links move with unit component c".
    fn image(&self, links: &[(LinkId, bool)], c: usize) -> Vec<Residue> {
        let (f, locks, dim) = (self.field, self.locks, self.places.dim);
        let mut out = vec![0; self.width()];
        for &(l, plus) in links {
            let Some(&at) = self.places.links.get(&l) else {
                continue;
            };
            for (o, lock) in out.iter_mut().zip(locks) {
                *o = if plus {
                    f.add(*o, lock[at + c])
                } else {
                    f.sub(*o, lock[at + c])
                };
            }
            for (k, _) in self.kept.iter().enumerate().filter(|(_, k)| **k == l) {
                let o = &mut out[locks.len() + k * dim + c];
                *o = if plus {
                    f.add(*o, f.one())
                } else {
                    f.sub(*o, f.one())
                };
            }
        }
        out
    }

    /// Images of what moves freely: whole components, unless they hold the frame.
    fn free(&self, components: &[Vec<LinkId>], frame: LinkId) -> Echelon {
        let mut free = Echelon::new(self.field);
        for component in components.iter().filter(|c| !c.contains(&frame)) {
            let together: Vec<(LinkId, bool)> = component.iter().map(|&l| (l, true)).collect();
            // A drive has a rate, and is no link that turns and slides.
            let is_drive = component.iter().all(|l| l.index() >= self.links);
            for c in 0..if is_drive { 1 } else { self.places.dim } {
                free.insert(&self.image(&together, c));
            }
        }
        free
    }
}

#[cfg(test)]
mod tests {
    use crate::model::drawn::{drawn, hinges};
    use crate::model::joint_type::Freedom;
    use crate::model::joint_type::{CoupledFreedom, Coupling};
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
