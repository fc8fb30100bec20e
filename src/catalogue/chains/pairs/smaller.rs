//! What is left of a gripper without two of its links.

use crate::chains::pairs::PairKind;
use crate::chains::pairs::chain::{PairChain, ordered};
use crate::chains::pairs::roles::PairRoles;
use crate::chains::pairs::structure::PairStructure;
use itertools::Itertools;

impl PairStructure {
    /// The grippers that two links less make: two links in a row that carry nothing else are taken out, and what hangs on them is left.
    /// A jaw that was one of the two is then a link on which they hung; an input there is the joint of these, where
    /// they are joined. The mobility by counting stays as it is; whether every two links move is not asked.
    ///
    /// # Complexity
    /// A few steps for each two joined links.
    #[must_use]
    pub fn without_two_links(&self) -> Vec<PairStructure> {
        let joints = self.chain.joints();
        let rows = joints.iter().filter_map(|j| Row::new(&self.chain, j.links));
        let free = rows.filter(|r| !r.links.contains(&self.roles.frame));
        free.flat_map(|row| self.without(row)).collect()
    }

    fn without(&self, row: Row) -> Vec<PairStructure> {
        let rest = (0..self.chain.links()).filter(|l| !row.links.contains(l));
        let rest = rest.collect_vec();
        let is_in = |l: &usize| row.links.contains(l);
        let roles = &self.roles;
        let input = if roles.input.iter().any(is_in) {
            ordered(row.ends)
        } else {
            roles.input
        };
        let driven = self.chain.between(input[0], input[1]);
        if !driven.is_some_and(PairKind::is_lower) {
            return Vec::new();
        }
        let becomes = |jaw: &usize| {
            if is_in(jaw) {
                row.ends.to_vec()
            } else {
                vec![*jaw]
            }
        };
        let jaws = roles.jaws.iter().map(becomes);
        let jaws = jaws.multi_cartesian_product();
        let apart = jaws.filter(|jaws| jaws.iter().chain([&roles.frame]).all_unique());
        let left = apart.map(|jaws| PairStructure {
            chain: self.chain.clone(),
            roles: PairRoles {
                input,
                jaws: jaws.into_iter().sorted_unstable().collect(),
                frame: roles.frame,
            },
        });
        left.map(|s| s.part(&rest)).collect()
    }
}

/// Two joined links that carry nothing else, and the two links on which they hang.
struct Row {
    links: [usize; 2],
    ends: [usize; 2],
}

impl Row {
    fn new(chain: &PairChain, links: [usize; 2]) -> Option<Row> {
        let [u, v] = links;
        let end = |of: usize, but: usize| {
            let others = (0..chain.links()).filter(|&l| l != but && chain.between(of, l).is_some());
            others.exactly_one().ok()
        };
        let ends = [end(u, v)?, end(v, u)?];
        (ends[0] != ends[1]).then_some(Row { links, ends })
    }
}
