//! Distributes kinds over the joints of a graph, each way once up to the graph's symmetries.
//!
//! Joints that change places under an involution have one kind. So one orbit is chosen at a time; without an involution, an
//! orbit is one joint.

use crate::chains::PairKind;
use crate::chains::canonical::Weighted;
use crate::chains::chain::{Chain, Joint, carry_links};
use crate::chains::motion::moves_throughout;
use itertools::Itertools;
use std::cmp::Ordering;

/// Kinds that may be distributed.
#[derive(Debug, Clone, Copy)]
pub struct Menu<'a> {
    /// Other kinds than hinges.
    pub kinds: &'a [PairKind],
    /// Maximum number of orbits of pairs that are not hinges.
    pub most: usize,
}

impl Menu<'_> {
    /// Returns the maximum number of joints of a chain of mobility 1 if `most_higher` may be pairs of two freedoms.
    pub(super) fn most_joints(self, links: usize, most_higher: usize) -> usize {
        let higher = self.kinds.iter().any(|k| k.leaves_two());
        let constraints = 3 * links - 4 + if higher { most_higher } else { 0 };
        (constraints / 2).min(links * (links - 1) / 2)
    }
}

/// A part that would be rigid with only hinges and slides.
struct Tight {
    /// Its joints, as bits.
    joints: u64,
    /// Minimum number of them that must leave two freedoms.
    least: u32,
}

/// Joints that change places, as bits.
#[derive(Clone, Copy)]
struct Orbit(u64);

impl Orbit {
    fn len(self) -> usize {
        self.0.count_ones() as usize
    }
}

pub(super) struct Sharing<'a> {
    links: usize,
    joints: Vec<[usize; 2]>,
    orbits: Vec<Orbit>,
    tight: Vec<Tight>,
    /// Images of the joints under each symmetry, with the symmetry.
    images: Vec<(Vec<usize>, &'a Vec<usize>)>,
}

impl<'a> Sharing<'a> {
    /// Creates the distribution for a graph with its automorphisms, if `swap` carries joints of one kind to each other.
    pub(super) fn new(
        graph: &Weighted,
        automorphisms: &'a [Vec<usize>],
        swap: &[usize],
    ) -> Sharing<'a> {
        let n = graph.vertices();
        let pairs = (0..n).flat_map(|v| (0..v).map(move |u| [u, v]));
        let joints = pairs.filter(|&[u, v]| graph.weight(u, v) > 0);
        let joints = joints.collect_vec();
        let image = |a: &[usize]| {
            let place = |&links: &[usize; 2]| {
                let links = carry_links(links, a);
                joints.iter().position(|&j| j == links).unwrap_or(0)
            };
            joints.iter().map(place).collect_vec()
        };
        let orbits = image(swap).into_iter().enumerate();
        let orbits = orbits.filter(|(j, to)| j <= to);
        let images = automorphisms.iter().map(|a| (image(a), a));
        Sharing {
            links: n,
            orbits: orbits.map(|(j, to)| Orbit(1 << j | 1 << to)).collect(),
            images: images.collect(),
            tight: tight_parts(n, &joints),
            joints,
        }
    }

    /// Returns the number of joints that leave two freedoms if the mobility is 1.
    fn higher_count(&self) -> Option<usize> {
        (2 * self.joints.len()).checked_sub((3 * self.links).checked_sub(4)?)
    }

    /// Calls `visit` with each chain and its automorphisms.
    pub(super) fn share_kinds(
        &self,
        menu: Menu<'_>,
        visit: &mut impl FnMut(Chain, Vec<&Vec<usize>>),
    ) {
        let Some(higher) = self.higher_count() else {
            return;
        };
        let (two, one): (Vec<PairKind>, Vec<PairKind>) =
            menu.kinds.iter().partition(|k| k.leaves_two());
        let orbits = 0..self.orbits.len();
        let fewest = higher.div_ceil(2);
        let chosen = (fewest..=higher.min(menu.most)).flat_map(|n| orbits.clone().combinations(n));
        for places in chosen {
            let all = places.iter().map(|&o| self.orbits[o]);
            let bits = all.clone().fold(0, |bits, o| bits | o.0);
            let loose = |t: &Tight| (t.joints & bits).count_ones() >= t.least;
            if all.map(Orbit::len).sum::<usize>() != higher || !self.tight.iter().all(loose) {
                continue;
            }
            let others = orbits.clone().filter(|o| !places.contains(o)).collect_vec();
            let most = (menu.most - places.len()).min(others.len());
            for n in 0..=most {
                for chosen in others.iter().copied().combinations(n) {
                    let kinds = [(&places, &two), (&chosen, &one)];
                    let kinds = kinds.map(|(orbits, kinds)| orbits.iter().map(move |_| kinds));
                    let kinds = kinds.into_iter().flatten().multi_cartesian_product();
                    for kinds in kinds {
                        let mut pairs = vec![PairKind::Hinge; self.joints.len()];
                        for (&orbit, &pair) in places.iter().chain(&chosen).zip(kinds) {
                            let own = |j: &usize| self.orbits[orbit].0 >> j & 1 == 1;
                            (0..pairs.len()).filter(own).for_each(|j| pairs[j] = pair);
                        }
                        self.judge_kinds(&pairs, visit);
                    }
                }
            }
        }
    }

    /// Visits the chain of these kinds if it is valid and no symmetry gives a lesser list.
    fn judge_kinds(&self, pairs: &[PairKind], visit: &mut impl FnMut(Chain, Vec<&Vec<usize>>)) {
        let mut keeping = Vec::new();
        for (image, automorphism) in &self.images {
            match image.iter().map(|&j| pairs[j]).cmp(pairs.iter().copied()) {
                Ordering::Less => return,
                Ordering::Equal => keeping.push(*automorphism),
                Ordering::Greater => {}
            }
        }
        let joints = self.joints.iter().zip(pairs);
        let joints = joints.map(|(&links, &pair)| Joint { links, pair });
        let chain = Chain::new(self.links, joints);
        // Without slides, the count of every part is enough.
        let slides = pairs.contains(&PairKind::Slide);
        if chain.has_carriers() && (!slides || moves_throughout(&chain)) {
            visit(chain, keeping);
        }
    }
}

/// Returns the parts that would have too many constraints with only hinges and slides.
fn tight_parts(links: usize, joints: &[[usize; 2]]) -> Vec<Tight> {
    let parts = 1u32..1 << links;
    let tight = parts.filter(|p| p.count_ones() > 1).filter_map(|part| {
        let inside = |[u, v]: &[usize; 2]| part >> u & part >> v & 1 == 1;
        let own = joints.iter().positions(inside);
        let joints = own.fold(0u64, |bits, j| bits | 1 << j);
        let least = (2 * joints.count_ones() + 4).checked_sub(3 * part.count_ones())?;
        (least > 0).then_some(Tight { joints, least })
    });
    tight.collect()
}
