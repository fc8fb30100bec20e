//! A gripper as a structure: a chain of pairs with its roles, under a name that does not depend on numbers. Also its parts, and the
//! structure that remains without two of its links.

use crate::chains::PairKind;
use crate::chains::canonical::{Weighted, number_graph};
use crate::chains::chain::{Chain, Joint, order_links};
use crate::chains::motion::moves_throughout;
use crate::chains::roles::{Roles, Subject};
use itertools::Itertools;

/// A chain with the roles of its links.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PairStructure {
    /// The chain.
    pub chain: Chain,
    /// The roles.
    pub roles: Roles,
}

/// Increment of the weight of the driven joint.
const DRIVEN: u8 = 8;

impl PairStructure {
    /// Returns the structure in canonical numbering, as a graph whose weights include the roles of links and joints. Two
    /// structures have equal keys exactly if they are the same.
    ///
    /// # Complexity
    /// As of [`number_graph`].
    #[must_use]
    pub fn canonical_key(&self) -> Weighted {
        number_graph(&self.weighted_graph()).graph
    }

    /// Returns the structure of a key, in canonical numbering.
    #[must_use]
    pub fn of_key(key: &Weighted) -> PairStructure {
        let links = 0..key.vertices();
        let at = |weight: u8| links.clone().filter(move |&l| key.weight(l, l) == weight);
        let between = links.clone().tuple_combinations().map(|(u, v)| [u, v]);
        let driven = |[u, v]: &[usize; 2]| key.weight(*u, *v) >= DRIVEN;
        let joints = between.clone().filter_map(|links @ [u, v]| {
            let pair = PairKind::of_weight(key.weight(u, v) % DRIVEN)?;
            Some(Joint { links, pair })
        });
        let input = between.clone().find(driven).unwrap_or_default();
        PairStructure {
            chain: Chain::new(key.vertices(), joints),
            roles: Roles {
                frame: at(1).next().unwrap_or_default(),
                input,
                jaws: at(2).collect(),
            },
        }
    }

    /// Returns true if the input slides.
    #[must_use]
    pub fn input_slides(&self) -> bool {
        let [u, v] = self.roles.input;
        self.chain.pair_between(u, v) == Some(PairKind::Slide)
    }

    fn weighted_graph(&self) -> Weighted {
        let mut out = Weighted::new(self.chain.links());
        for joint in self.chain.joints() {
            let [u, v] = joint.links;
            let driven = u8::from(joint.links == self.roles.input) * DRIVEN;
            out.set(u, v, joint.pair as u8 + driven);
        }
        out.set(self.roles.frame, self.roles.frame, 1);
        self.roles.jaws.iter().for_each(|&j| out.set(j, j, 2));
        out
    }

    /// Returns the name: a letter for each two links, (0, 1), (0, 2), (1, 2) and so on, then frame, input and jaws, in canonical
    /// numbering. Two structures have equal names exactly if they are the same.
    #[must_use]
    pub fn name(&self) -> String {
        let PairStructure { chain, roles } = PairStructure::of_key(&self.canonical_key());
        let ([i, k], jaws) = (roles.input, roles.jaws.iter().join(","));
        format!("{} f{} i{i}-{k} j{jaws}", chain.pair_code(), roles.frame)
    }

    /// Returns the links of the smallest moving part that contains all roles. These are all links if the structure is essential. They are
    /// also all links if in nearly all places there is no single motion in which every two links move. In that case a count does not
    /// determine the parts.
    ///
    /// # Complexity
    /// A step for each set of links.
    #[must_use]
    pub fn essential_links(&self) -> Vec<usize> {
        let automorphisms = self.chain.automorphisms();
        let subject = Subject::new(&self.chain, &automorphisms);
        let parts = subject.moving_parts_with(&self.roles);
        let least = parts.min_by_key(|p| p.count_ones());
        let least = least.filter(|_| moves_throughout(&self.chain));
        let links = 0..self.chain.links();
        let within = |l: &usize| least.is_none_or(|part| part >> l & 1 == 1);
        links.filter(within).collect()
    }

    /// Returns the structure of only some of the links, with the joints between them.
    #[must_use]
    pub fn part_of(&self, links: &[usize]) -> PairStructure {
        let place = |l: usize| links.iter().position(|&x| x == l);
        let joints = self.chain.joints().into_iter().filter_map(|mut j| {
            let [u, v] = j.links.map(place);
            j.links = order_links([u?, v?]);
            Some(j)
        });
        let mut places = vec![0; self.chain.links()];
        links.iter().enumerate().for_each(|(at, &l)| places[l] = at);
        PairStructure {
            chain: Chain::new(links.len(), joints),
            roles: self.roles.image_under(&places),
        }
    }
}
