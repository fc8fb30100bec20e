//! A chain whose joints are of one kind or several.

use crate::chains::PairKind;
use crate::chains::canonical::{Canonical, Weighted, number_graph};
use petgraph::unionfind::UnionFind;

/// Maximum number of links of a chain of pairs. Every set of its links is examined, as the bits of a word.
pub(crate) const MOST_LINKS: usize = 12;

/// A chain: which links are joined, and by what.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Chain {
    pairs: Weighted,
}

/// Returns two links in ascending order.
#[must_use]
pub(crate) fn order_links([u, v]: [usize; 2]) -> [usize; 2] {
    [u.min(v), u.max(v)]
}

/// Returns the images of two links under an automorphism, in ascending order.
#[must_use]
pub(crate) fn carry_links(links: [usize; 2], by: &[usize]) -> [usize; 2] {
    order_links(links.map(|l| by[l]))
}

/// A joint of a chain: its links, the lesser first, and its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Joint {
    /// The links.
    pub links: [usize; 2],
    /// The kind.
    pub pair: PairKind,
}

impl Joint {
    /// Returns true if it joins a link to another.
    #[must_use]
    pub(crate) fn is_at(&self, link: usize) -> bool {
        self.links.contains(&link)
    }
}

impl Chain {
    /// Returns the chain of N links with these joints. Two slots between the same links become one joint.
    ///
    /// # Examples
    /// ```
    /// use ozols::chains::{PairKind, chain::{Chain, Joint}};
    /// let joint = |links, pair| Joint { links, pair };
    /// let hinges = [[0, 1], [0, 2]].map(|links| joint(links, PairKind::Hinge));
    /// let gears = Chain::new(3, hinges.into_iter().chain([joint([1, 2], PairKind::Gear)]));
    /// assert_eq!(gears.mobility(), 1); // A gear takes one freedom, a hinge two.
    /// ```
    #[must_use]
    pub fn new(links: usize, joints: impl IntoIterator<Item = Joint>) -> Chain {
        let mut pairs = Weighted::new(links);
        for joint in joints {
            let [u, v] = joint.links;
            let twice = [joint.pair as u8, pairs.weight(u, v)] == [PairKind::Slot as u8; 2];
            let pair = if twice {
                PairKind::TwoSlots
            } else {
                joint.pair
            };
            pairs.set(u, v, pair as u8);
        }
        Chain { pairs }
    }

    /// Returns the chain of N links with these hinges.
    ///
    /// # Examples
    /// ```
    /// use ozols::chains::chain::Chain;
    /// let four_bar = Chain::with_hinges(4, [(0, 1), (1, 2), (2, 3), (3, 0)]);
    /// assert_eq!((four_bar.links(), four_bar.joints().len(), four_bar.mobility()), (4, 4, 1));
    /// ```
    #[must_use]
    pub fn with_hinges(links: usize, joints: impl IntoIterator<Item = (usize, usize)>) -> Chain {
        let pair = PairKind::Hinge;
        let joints = joints.into_iter().map(|(u, v)| [u, v]);
        Chain::new(links, joints.map(|links| Joint { links, pair }))
    }

    /// Returns the chain of a contracted graph and its strings. A string of N hinges has N - 1 binary links.
    pub(super) fn of_strings(links: usize, ends: &[(usize, usize)], joints: &[u8]) -> Chain {
        let binary: usize = joints.iter().map(|&x| usize::from(x) - 1).sum();
        let mut next = links;
        let mut all = Vec::with_capacity(links + binary);
        for (&(u, v), &x) in ends.iter().zip(joints) {
            let mut at = u;
            for _ in 1..x {
                all.push((at, next));
                (at, next) = (next, next + 1);
            }
            all.push((at, v));
        }
        Chain::with_hinges(links + binary, all)
    }

    /// Returns the chain with another joint between two links that are joined.
    #[must_use]
    pub(crate) fn with_pair(mut self, [u, v]: [usize; 2], pair: PairKind) -> Chain {
        self.pairs.set(u, v, pair as u8);
        self
    }

    /// Returns the number of links.
    #[must_use]
    pub fn links(&self) -> usize {
        self.pairs.vertices()
    }

    /// Returns the pair that joins two links.
    #[must_use]
    pub fn pair_between(&self, u: usize, v: usize) -> Option<PairKind> {
        PairKind::of_weight(self.pairs.weight(u, v))
    }

    /// Returns the joints, by their greater link and then by the lesser.
    #[must_use]
    pub fn joints(&self) -> Vec<Joint> {
        let pairs = (0..self.links()).flat_map(|v| (0..v).map(move |u| [u, v]));
        let joint = |links: [usize; 2]| Some((links, self.pair_between(links[0], links[1])?));
        let joints = pairs.filter_map(joint);
        joints.map(|(links, pair)| Joint { links, pair }).collect()
    }

    /// Returns the joints as built: two slots are two joints.
    #[must_use]
    pub fn joints_made(&self) -> Vec<Joint> {
        let made = |joint: Joint| match joint.pair {
            PairKind::TwoSlots => {
                let pair = PairKind::Slot;
                vec![Joint { pair, ..joint }; 2]
            }
            _ => vec![joint],
        };
        self.joints().into_iter().flat_map(made).collect()
    }

    /// Returns whether two links are joined.
    #[must_use]
    pub fn is_joined(&self, u: usize, v: usize) -> bool {
        self.pairs.weight(u, v) > 0
    }

    /// Returns the mobility, from the numbers of links and joints.
    #[must_use]
    pub fn mobility(&self) -> usize {
        let joints = self.joints().into_iter();
        let taken: usize = joints
            .map(|j| if j.pair.leaves_two() { 1 } else { 2 })
            .sum();
        (3 * (self.links() - 1)).saturating_sub(taken)
    }

    /// Returns a letter for the pair of each two links, (0, 1), (0, 2), (1, 2) and so on, or - if they are not joined.
    #[must_use]
    pub fn pair_code(&self) -> String {
        let pairs = (0..self.links()).flat_map(|v| (0..v).map(move |u| (u, v)));
        let letter = |(u, v)| self.pair_between(u, v).map_or('-', PairKind::code_letter);
        pairs.map(letter).collect()
    }

    /// Returns the chain of a code, or `None` if the code is invalid.
    ///
    /// # Examples
    /// ```
    /// use ozols::chains::chain::Chain;
    /// let four_bar = Chain::with_hinges(4, [(0, 1), (1, 2), (2, 3), (3, 0)]);
    /// assert_eq!(Chain::of_code(4, &four_bar.pair_code()), Some(four_bar));
    /// assert_eq!(Chain::of_code(4, "?"), None);
    /// ```
    #[must_use]
    pub fn of_code(links: usize, code: &str) -> Option<Chain> {
        let pairs = (0..links).flat_map(|v| (0..v).map(move |u| [u, v]));
        let mut letters = code.chars();
        let mut joints = Vec::new();
        for links in pairs {
            match letters.next()? {
                '-' => {}
                letter => {
                    let pair = PairKind::of_letter(letter)?;
                    joints.push(Joint { links, pair });
                }
            }
        }
        (letters.next().is_none()).then(|| Chain::new(links, joints))
    }

    /// Returns the number of joints of a kind.
    #[must_use]
    pub fn count_pairs(&self, pair: PairKind) -> usize {
        self.joints().iter().filter(|j| j.pair == pair).count()
    }

    /// Returns the slots between links that slides join already, so that they do not rotate relative to each other. These may have
    /// flat faces, as a wedge in its guide has.
    ///
    /// # Complexity
    /// O(m) for m joints.
    #[must_use]
    pub fn flat_slots(&self) -> Vec<Joint> {
        let mut together = UnionFind::<usize>::new(self.links());
        let joints = self.joints();
        for joint in joints.iter().filter(|j| j.pair == PairKind::Slide) {
            together.union(joint.links[0], joint.links[1]);
        }
        let flat = |j: &Joint| {
            j.pair == PairKind::Slot && together.find(j.links[0]) == together.find(j.links[1])
        };
        joints.into_iter().filter(flat).collect()
    }

    /// Returns the mobility of every set of links with the joints between them. The index is the set, as bits.
    ///
    /// # Complexity
    /// O(2ⁿ) for n links.
    #[must_use]
    pub fn part_mobilities(&self) -> Vec<i16> {
        let mut out = vec![-3i16; 1 << self.links()];
        for part in 1..out.len() {
            let last = part.ilog2() as usize;
            let rest = part & !(1 << last);
            let others = (0..last).filter(|u| rest >> u & 1 == 1);
            let taken = others.map(|u| match self.pair_between(u, last) {
                None => 0,
                Some(pair) if pair.leaves_two() => 1,
                Some(_) => 2,
            });
            out[part] = out[rest] + 3 - taken.sum::<i16>();
        }
        out
    }

    /// Returns true if every gear pair has a carrier: a link that is hinged to both gears, or to the pinion and slides on the rack.
    #[must_use]
    pub fn has_carriers(&self) -> bool {
        let is_carrier = |link: usize, [u, v]: [usize; 2]| {
            let both = [self.pair_between(link, u), self.pair_between(link, v)];
            let lower = both.iter().all(|p| p.is_some_and(PairKind::is_lower));
            lower && both.contains(&Some(PairKind::Hinge))
        };
        let mut joints = self.joints().into_iter();
        joints.all(|j| {
            j.pair != PairKind::Gear || (0..self.links()).any(|link| is_carrier(link, j.links))
        })
    }

    /// Returns the automorphisms as images of the links, including the identity.
    ///
    /// # Complexity
    /// As of [`canonical`].
    ///
    /// # Examples
    /// ```
    /// use ozols::chains::chain::Chain;
    /// let four_bar = Chain::with_hinges(4, [(0, 1), (1, 2), (2, 3), (3, 0)]);
    /// assert_eq!(four_bar.automorphisms().len(), 8); // Those of a square.
    /// ```
    #[must_use]
    pub fn automorphisms(&self) -> Vec<Vec<usize>> {
        number_graph(&self.pairs).automorphisms
    }

    /// Returns the chain in its canonical numbering, with its automorphisms. Two chains are equal then exactly if they are isomorphic.
    ///
    /// # Complexity
    /// As of [`canonical`].
    #[must_use]
    pub fn canonical_form(&self) -> (Chain, Vec<Vec<usize>>) {
        let Canonical {
            graph,
            order,
            automorphisms,
        } = number_graph(&self.pairs);
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, &v)| place[v] = at);
        let renumbered = |a: &Vec<usize>| order.iter().map(|&v| place[a[v]]).collect();
        let automorphisms = automorphisms.iter().map(renumbered).collect();
        (Chain { pairs: graph }, automorphisms)
    }
}
