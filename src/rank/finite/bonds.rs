//! Chains and parallel legs put together as groups of displacements, as far as that goes.
//!
//! A chain of joints between two links lets them move in a product of one-parameter groups. Where the twists of neighbours in
//! it span a subalgebra, the product is, near this pose, the whole group of that algebra: its derivative has that rank. So
//! they are one joint, with as many freedoms as the group has dimensions, and what they have beyond that moves inside the
//! chain. Two such joints side by side let the links move in the common part of their groups, again a group. Both steps are
//! exact, so that a mechanism that comes down to single joints has a manifold of closed poses whose dimension is counted on
//! the way: Sarrus' linkage is two planes that have a direction in common [Hervé 1978, "mechanical bonds"].

use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{Echelon, relations};
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{LinkId, Mechanism, Mode};
use crate::rank::finite::displacement_group::{bracket, spatial_twists};

type Twist = Vec<Residue>;

/// Joints in series between two links, each free to move in the group that its twists span.
#[derive(Debug, Clone)]
struct Chain {
    ends: [LinkId; 2],
    groups: Vec<Vec<Twist>>,
}

impl Chain {
    fn is_closed(&self) -> bool {
        self.ends[0] == self.ends[1]
    }

    fn reversed(mut self) -> Chain {
        self.ends.reverse();
        self.groups.reverse();
        self
    }
}

/// The finite mobility of the joints of a closure by groups alone; none where they do not come down to single joints.
///
/// # Errors
/// Where a coordinate has no value in the field.
///
/// # Complexity
/// O(p²) products of algebras for p freedoms.
pub fn mobility(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Result<Option<usize>, ExactError> {
    // In a plane contours need no more than their own three rows.
    if matches!(mechanism.mode, Mode::Planar { .. }) || !closure.couplings.is_empty() {
        return Ok(None);
    }
    let mut chains = Vec::new();
    for j in mechanism.joints_in(closure.state) {
        // In the order they are passed in, as in `motion::pose`: slides first, but a slot after its pin.
        let freedoms = mechanism.joints[j].joint_type.freedoms();
        let slot = freedoms.contains(&Freedom::Tx) && !freedoms.contains(&Freedom::Ty);
        let twists = spatial_twists(exact, mechanism, j)?;
        let mut passed: Vec<(Freedom, Twist)> = freedoms.iter().copied().zip(twists).collect();
        passed.sort_by_key(|(f, _)| f.slides() == slot);
        chains.push(Chain {
            ends: mechanism.joints[j].links,
            groups: passed.into_iter().map(|(_, t)| vec![t]).collect(),
        });
    }
    let mut bonds = Bonds {
        exact,
        chains,
        mobility: 0,
    };
    let links: Vec<LinkId> = mechanism.link_ids().collect();
    while bonds.join(&links) || bonds.merge() || bonds.close() || bonds.side_by_side() {}
    Ok(bonds.chains.is_empty().then_some(bonds.mobility))
}

struct Bonds<'a> {
    exact: &'a ExactField,
    chains: Vec<Chain>,
    /// What moves inside what was put together.
    mobility: usize,
}

impl Bonds<'_> {
    /// Two chains that meet at a link with no others become one; a chain that ends loosely moves as it likes.
    fn join(&mut self, links: &[LinkId]) -> bool {
        for &link in links {
            let at: Vec<usize> = (0..self.chains.len())
                .filter(|&c| self.chains[c].ends.contains(&link))
                .collect();
            if at.iter().any(|&c| self.chains[c].is_closed()) {
                continue;
            }
            match at[..] {
                [c] => {
                    let loose = self.chains.remove(c);
                    self.mobility += loose.groups.iter().map(Vec::len).sum::<usize>();
                    return true;
                }
                [a, b] => {
                    let to = |c: Chain| if c.ends[1] == link { c } else { c.reversed() };
                    let second = to(self.chains.remove(b)).reversed();
                    let first = to(self.chains.remove(a));
                    let groups = first.groups.into_iter().chain(second.groups).collect();
                    self.chains.push(Chain {
                        ends: [first.ends[0], second.ends[1]],
                        groups,
                    });
                    return true;
                }
                _ => {}
            }
        }
        false
    }

    /// Neighbours whose twists span a subalgebra become one group; round a closed chain the last is the first's neighbour.
    fn merge(&mut self) -> bool {
        for c in 0..self.chains.len() {
            let chain = &self.chains[c];
            let (n, closed) = (chain.groups.len(), chain.is_closed());
            for length in (2..=n.saturating_sub(usize::from(closed))).rev() {
                for from in 0..if closed { n } else { n + 1 - length } {
                    let mut turned = chain.groups.clone();
                    turned.rotate_left(from);
                    let (part, rest) = turned.split_at(length);
                    let Some(group) = self.spanned(part) else {
                        continue;
                    };
                    self.mobility += part.iter().map(Vec::len).sum::<usize>() - group.len();
                    let mut groups = vec![group];
                    groups.extend_from_slice(rest);
                    if !closed {
                        groups.rotate_right(from);
                    }
                    self.chains[c].groups = groups;
                    return true;
                }
            }
        }
        false
    }

    /// A closed chain of two groups moves in what they have in common, one of a single group not at all.
    fn close(&mut self) -> bool {
        let Some(c) = self
            .chains
            .iter()
            .position(|c| c.is_closed() && c.groups.len() <= 2)
        else {
            return false;
        };
        let chain = self.chains.remove(c);
        if let [a, b] = &chain.groups[..] {
            self.mobility += common(self.exact, a, b).len();
        }
        true
    }

    /// Two single groups between the same links let them move in what they have in common.
    fn side_by_side(&mut self) -> bool {
        let single = |c: &Chain| c.groups.len() <= 1 && !c.is_closed();
        for b in 0..self.chains.len() {
            for a in 0..b {
                let (x, y) = (&self.chains[a], &self.chains[b]);
                let alike = x.ends == y.ends || x.ends == [y.ends[1], y.ends[0]];
                if !(alike && single(x) && single(y)) {
                    continue;
                }
                let groups = match (&x.groups[..], &y.groups[..]) {
                    ([a], [b]) => vec![common(self.exact, a, b)],
                    _ => Vec::new(),
                };
                self.chains[a].groups = groups;
                self.chains.remove(b);
                return true;
            }
        }
        false
    }

    /// The algebra that some groups span together, where that is one.
    fn spanned(&self, groups: &[Vec<Twist>]) -> Option<Vec<Twist>> {
        let mut span = Echelon::new(self.exact.field());
        let mut basis: Vec<&Twist> = Vec::new();
        for t in groups.iter().flatten() {
            if span.insert(t) {
                basis.push(t);
            }
        }
        let closed = |(i, a): (usize, &&Twist)| {
            basis[..i]
                .iter()
                .all(|b| span.contains(&bracket(self.exact, a, b)))
        };
        basis
            .iter()
            .enumerate()
            .all(closed)
            .then(|| basis.into_iter().cloned().collect())
    }
}

/// A basis of the common part of two spans, each given by independent vectors.
pub(in crate::rank) fn common(exact: &ExactField, a: &[Twist], b: &[Twist]) -> Vec<Twist> {
    let field = exact.field();
    let both: Vec<Twist> = a.iter().chain(b).cloned().collect();
    relations(field, &both)
        .into_iter()
        .map(|combination| {
            let mut sum = vec![0; 6];
            for (&x, t) in combination.iter().zip(a) {
                for (s, &y) in sum.iter_mut().zip(t) {
                    *s = field.add(*s, field.mul(x, y));
                }
            }
            sum
        })
        .collect()
}
