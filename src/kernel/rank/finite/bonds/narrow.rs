//! Restriction of groups to the subgroup that instantaneous motions use.

use super::{BondPart, Bonds, Twist};
use crate::linalg::echelon::{Echelon, combination, relations};
use crate::linalg::modp::Residue;
use crate::model::mechanism::LinkId;
use std::collections::{HashMap, VecDeque};

/// A spanning forest of the chains.
struct Forest {
    /// For each link, the chains from a root to it, each with its direction of passage.
    ways: HashMap<LinkId, Vec<(usize, i32)>>,
    /// The chains that close contours.
    closing: Vec<usize>,
}

impl Bonds<'_> {
    /// Restricts groups of which every instantaneous motion uses only a subgroup.
    pub(super) fn narrow(&mut self) -> bool {
        let motions = relations(self.exact.field(), &self.columns());
        let mut narrowed = false;
        let mut at = 0;
        for c in 0..self.chains.len() {
            let mut kept = Vec::new();
            for part in self.chains[c].parts.clone() {
                let width = part.span.len();
                let used = self.used(&part, motions.iter().map(|m| &m[at..at + width]));
                at += width;
                let fewer = used.len() < width && (part.is_group() || used.is_empty());
                if fewer && self.is_algebra(&used.iter().collect::<Vec<_>>()) {
                    narrowed = true;
                    if !used.is_empty() {
                        kept.push(BondPart::group(used));
                    }
                } else {
                    kept.push(part);
                }
            }
            self.chains[c].parts = kept;
        }
        narrowed
    }

    /// Returns a basis of the twists of a part in some motions, given by the weights of its twists.
    fn used<'a>(
        &self,
        part: &BondPart,
        motions: impl Iterator<Item = &'a [Residue]>,
    ) -> Vec<Twist> {
        let field = self.exact.field();
        let mut span = Echelon::new(field);
        motions
            .map(|weights| combination(field, &part.span, weights))
            .filter(|t| span.insert(t))
            .collect()
    }

    /// Returns the columns of the closure matrix of the chains: six rows for each chain outside a spanning forest.
    fn columns(&self) -> Vec<Vec<Residue>> {
        let field = self.exact.field();
        let Forest { ways, closing } = self.forest();
        let mut columns = Vec::new();
        for (c, chain) in self.chains.iter().enumerate() {
            let signs: Vec<i32> = closing
                .iter()
                .map(|&k| {
                    let [from, to] = self.chains[k].ends;
                    let of = |l: LinkId| ways[&l].iter().find(|w| w.0 == c).map_or(0, |w| w.1);
                    i32::from(c == k) + of(from) - of(to)
                })
                .collect();
            for twist in chain.parts.iter().flat_map(|p| &p.span) {
                let column = signs.iter().flat_map(|&sign| {
                    twist.iter().map(move |&x| match sign {
                        0 => 0,
                        1 => x,
                        _ => field.neg(x),
                    })
                });
                columns.push(column.collect());
            }
        }
        columns
    }

    fn forest(&self) -> Forest {
        let mut ways: HashMap<LinkId, Vec<(usize, i32)>> = HashMap::new();
        let mut in_forest = vec![false; self.chains.len()];
        for chain in &self.chains {
            let root = chain.ends[0];
            if ways.contains_key(&root) {
                continue;
            }
            ways.insert(root, Vec::new());
            let mut open = VecDeque::from([root]);
            while let Some(link) = open.pop_front() {
                for (c, chain) in self.chains.iter().enumerate() {
                    let (next, sign) = match chain.ends {
                        [a, b] if a == link => (b, 1),
                        [a, b] if b == link => (a, -1),
                        _ => continue,
                    };
                    if !ways.contains_key(&next) {
                        in_forest[c] = true;
                        let way = [&ways[&link][..], &[(c, sign)]].concat();
                        ways.insert(next, way);
                        open.push_back(next);
                    }
                }
            }
        }
        let closing = (0..self.chains.len()).filter(|&c| !in_forest[c]).collect();
        Forest { ways, closing }
    }
}
