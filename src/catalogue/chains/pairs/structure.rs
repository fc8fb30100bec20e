//! A gripper as a structure: a chain of pairs with its roles, under a name that does not depend on numbers.

use crate::chains::canonical::{Weighted, canonical};
use crate::chains::pairs::PairKind;
use crate::chains::pairs::chain::{Joint, PairChain, ordered};
use crate::chains::pairs::motion::moves_throughout;
use crate::chains::pairs::roles::{PairRoles, PairSubject};
use itertools::Itertools;

/// A chain with the roles of its links.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PairStructure {
    /// The chain.
    pub chain: PairChain,
    /// The roles.
    pub roles: PairRoles,
}

/// What is added to the weight of the driven joint.
const DRIVEN: u8 = 8;

impl PairStructure {
    /// The structure in canonical numbering, as a graph whose links and joints weigh more by what they do: equal for two
    /// structures exactly where they are the same.
    ///
    /// # Complexity
    /// As of [`canonical`].
    #[must_use]
    pub fn key(&self) -> Weighted {
        canonical(&self.weighted()).graph
    }

    /// The structure of a key: in canonical numbering, the one of its name.
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
            chain: PairChain::new(key.vertices(), joints),
            roles: PairRoles {
                frame: at(1).next().unwrap_or_default(),
                input,
                jaws: at(2).collect(),
            },
        }
    }

    /// Whether the input slides.
    #[must_use]
    pub fn slides(&self) -> bool {
        let [u, v] = self.roles.input;
        self.chain.between(u, v) == Some(PairKind::Slide)
    }

    fn weighted(&self) -> Weighted {
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

    /// The name: a letter for each two links, (0, 1), (0, 2), (1, 2) and so on, then frame, input and jaws, in canonical
    /// numbering; equal for two structures exactly where they are the same.
    #[must_use]
    pub fn name(&self) -> String {
        let PairStructure { chain, roles } = PairStructure::of_key(&self.key());
        let ([i, k], jaws) = (roles.input, roles.jaws.iter().join(","));
        format!("{} f{} i{i}-{k} j{jaws}", chain.code(), roles.frame)
    }

    /// The links of the smallest moving part that holds all roles: all links where the structure is essential, or has in nearly
    /// all places no one motion in which every two links move, so that counting tells nothing of parts.
    ///
    /// # Complexity
    /// A step for each set of links.
    #[must_use]
    pub fn essential_links(&self) -> Vec<usize> {
        let automorphisms = self.chain.automorphisms();
        let automorphisms = automorphisms.iter().collect_vec();
        let subject = PairSubject::new(&self.chain, &automorphisms);
        let parts = subject.moving_parts_with(&self.roles);
        let least = parts.min_by_key(|p| p.count_ones());
        let least = least.filter(|_| moves_throughout(&self.chain));
        let links = 0..self.chain.links();
        let within = |l: &usize| least.is_none_or(|part| part >> l & 1 == 1);
        links.filter(within).collect()
    }

    /// The structure of some of the links alone, with the joints between them.
    #[must_use]
    pub fn part(&self, links: &[usize]) -> PairStructure {
        let place = |l: usize| links.iter().position(|&x| x == l);
        let joints = self.chain.joints().into_iter().filter_map(|mut j| {
            let [u, v] = j.links.map(place);
            j.links = ordered([u?, v?]);
            Some(j)
        });
        let mut places = vec![0; self.chain.links()];
        links.iter().enumerate().for_each(|(at, &l)| places[l] = at);
        PairStructure {
            chain: PairChain::new(links.len(), joints),
            roles: self.roles.image(&places),
        }
    }
}
