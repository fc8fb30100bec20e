//! Reduction of chains and parallel legs to groups of displacements, as far as possible.
//!
//! A chain of joints between two links lets them move in a product of one-parameter groups. If the twists of
//! neighbouring joints span a subalgebra, the product is, near this pose, the whole group of that algebra, because its
//! derivative has that rank. So the joints are equivalent to one joint with as many freedoms as the group has
//! dimensions. Any further freedoms move inside the chain.
//!
//! Two such joints in parallel let the links move in the intersection of their groups, which is again a group. Both
//! steps are exact. So a mechanism that reduces to single joints has a manifold of closed poses, and the reduction
//! counts its dimension. Sarrus' linkage is two planes with a direction in common [Hervé 1978, "mechanical bonds"].
//!
//! Two equal parallel bars on parallel hinges let the links they join move on a circle without turning. This is not a
//! group, but it lies within the group of the slides in a plane, and a leg with such slides is a group again. If no
//! instantaneous motion uses more of a group than a subgroup, the group is restricted to it. For example, legs of a
//! robot that only turns about z may be able to turn otherwise, but do not. The mobility found is then a lower bound.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{Echelon, relations};
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{LinkId, Mechanism, Mode};
use crate::rank::finite::displacement_group::{bracket, spatial_twists};

mod narrow;
mod parallelogram;

type Twist = Vec<Residue>;

/// An equivalent joint: a manifold of displacements.
#[derive(Debug, Clone)]
struct BondPart {
    /// A basis of its twists in this pose.
    span: Vec<Twist>,
    /// A basis of the algebra of a group that contains all its displacements.
    within: Vec<Twist>,
}

impl BondPart {
    /// Creates a part with all displacements of a group.
    fn group(basis: Vec<Twist>) -> BondPart {
        BondPart {
            span: basis.clone(),
            within: basis,
        }
    }

    fn is_group(&self) -> bool {
        self.span.len() == self.within.len()
    }
}

/// Parts in series between two links.
#[derive(Debug, Clone)]
struct Chain {
    ends: [LinkId; 2],
    parts: Vec<BondPart>,
}

impl Chain {
    fn is_closed(&self) -> bool {
        self.ends[0] == self.ends[1]
    }

    fn reversed(mut self) -> Chain {
        self.ends.reverse();
        self.parts.reverse();
        self
    }
}

/// Returns the finite mobility of the joints of a closure by groups only, or `None` if they do not reduce to single
/// joints.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// O(p²) products of algebras for p freedoms.
pub fn mobility(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Result<Option<usize>, ExactError> {
    // In a plane, contours need only their own three rows.
    if matches!(mechanism.mode, Mode::Planar { .. }) || !closure.couplings.is_empty() {
        return Ok(None);
    }
    let mut chains = Vec::new();
    for j in mechanism.joints_in(closure.state) {
        let joint_type = &mechanism.joints[j].joint_type;
        let order = joint_type.passed();
        let twists = spatial_twists(exact, mechanism, j)?;
        let listed = joint_type.freedoms().iter().copied();
        let mut passed: Vec<(Freedom, Twist)> = listed.zip(twists).collect();
        passed.sort_by_key(|(f, _)| order.iter().position(|g| g == f));
        chains.push(Chain {
            ends: mechanism.joints[j].links,
            parts: passed
                .into_iter()
                .map(|(_, t)| BondPart::group(vec![t]))
                .collect(),
        });
    }
    let mut bonds = Bonds {
        exact,
        chains,
        mobility: 0,
    };
    let links: Vec<LinkId> = mechanism.link_ids().collect();
    while bonds.join(&links)
        || bonds.parallelogram()
        || bonds.merge()
        || bonds.close()
        || bonds.side_by_side()
        || bonds.narrow()
    {}
    Ok(bonds.chains.is_empty().then_some(bonds.mobility))
}

struct Bonds<'a> {
    exact: &'a ExactField,
    chains: Vec<Chain>,
    /// Mobility inside the merged parts.
    mobility: usize,
}

impl Bonds<'_> {
    /// Joins two chains that meet at a link with no other chain. A chain with a free end moves freely.
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
                    self.mobility += loose.parts.iter().map(|p| p.span.len()).sum::<usize>();
                    return true;
                }
                [a, b] => {
                    let to = |c: Chain| if c.ends[1] == link { c } else { c.reversed() };
                    let second = to(self.chains.remove(b)).reversed();
                    let first = to(self.chains.remove(a));
                    let parts = first.parts.into_iter().chain(second.parts).collect();
                    self.chains.push(Chain {
                        ends: [first.ends[0], second.ends[1]],
                        parts,
                    });
                    return true;
                }
                _ => {}
            }
        }
        false
    }

    /// Merges neighbours whose twists span a subalgebra into one group. In a closed chain the last part is a neighbour
    /// of the first.
    fn merge(&mut self) -> bool {
        for c in 0..self.chains.len() {
            let chain = &self.chains[c];
            let (n, closed) = (chain.parts.len(), chain.is_closed());
            for length in (2..=n.saturating_sub(usize::from(closed))).rev() {
                for from in 0..if closed { n } else { n + 1 - length } {
                    let mut turned = chain.parts.clone();
                    turned.rotate_left(from);
                    let (part, rest) = turned.split_at(length);
                    let Some(group) = self.spanned(part) else {
                        continue;
                    };
                    let all: usize = part.iter().map(|p| p.span.len()).sum();
                    self.mobility += all - group.len();
                    let mut parts = vec![BondPart::group(group)];
                    parts.extend_from_slice(rest);
                    if !closed {
                        parts.rotate_right(from);
                    }
                    self.chains[c].parts = parts;
                    return true;
                }
            }
        }
        false
    }

    /// Closes a chain on itself. A closed chain of two groups moves in their intersection; one of a single group does
    /// not move.
    fn close(&mut self) -> bool {
        let Some(c) = self.chains.iter().position(|c| {
            c.is_closed() && c.parts.len() <= 2 && c.parts.iter().all(BondPart::is_group)
        }) else {
            return false;
        };
        let chain = self.chains.remove(c);
        if let [a, b] = &chain.parts[..] {
            self.mobility += common(self.exact, &a.span, &b.span).len();
        }
        true
    }

    /// Replaces two single groups between the same links by their intersection.
    fn side_by_side(&mut self) -> bool {
        let single = |c: &Chain| {
            c.parts.len() <= 1 && !c.is_closed() && c.parts.iter().all(BondPart::is_group)
        };
        for b in 0..self.chains.len() {
            for a in 0..b {
                let (x, y) = (&self.chains[a], &self.chains[b]);
                let alike = x.ends == y.ends || x.ends == [y.ends[1], y.ends[0]];
                if !(alike && single(x) && single(y)) {
                    continue;
                }
                let parts = match (&x.parts[..], &y.parts[..]) {
                    ([a], [b]) => vec![BondPart::group(common(self.exact, &a.span, &b.span))],
                    _ => Vec::new(),
                };
                self.chains[a].parts = parts;
                self.chains.remove(b);
                return true;
            }
        }
        false
    }

    /// Returns the algebra that some parts span together, if the span is an algebra and contains all their
    /// displacements.
    fn spanned(&self, parts: &[BondPart]) -> Option<Vec<Twist>> {
        let mut span = Echelon::new(self.exact.field());
        let mut basis: Vec<&Twist> = Vec::new();
        for t in parts.iter().flat_map(|p| &p.span) {
            if span.insert(t) {
                basis.push(t);
            }
        }
        let inside = |p: &BondPart| p.within.iter().all(|t| span.contains(t));
        let group = parts.iter().all(inside) && self.is_algebra(&basis);
        group.then(|| basis.into_iter().cloned().collect())
    }

    /// Returns true if some independent twists span an algebra.
    fn is_algebra(&self, basis: &[&Twist]) -> bool {
        let mut span = Echelon::new(self.exact.field());
        basis.iter().all(|t| span.insert(t))
            && basis.iter().enumerate().all(|(i, a)| {
                let mut before = basis[..i].iter();
                before.all(|b| span.contains(&bracket(self.exact, a, b)))
            })
    }
}

/// Returns a basis of the intersection of two spans, each given by independent vectors.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{drawn, hinges};
    use crate::model::mechanism::StateId;
    use crate::rank::exact::field::field_of;

    /// Three bodies on one axis, each pair joined by two hinges: two bodies turn against the first, whichever link a
    /// hinge names first.
    #[test]
    fn hinges_side_by_side_are_one_whichever_link_they_name_first() {
        for turned in 0..8 {
            let pair = |i: usize| {
                let (a, b) = (i / 2, (i / 2 + 1) % 3);
                let swapped = i % 2 == 1 && turned >> (i / 2) & 1 == 1;
                let high = f64::from(u8::try_from(i).unwrap());
                (if swapped { [b, a] } else { [a, b] }, [0.0, 0.0, high])
            };
            let m = drawn(&hinges(&(0..6).map(pair).collect::<Vec<_>>()), &[]);
            let exact = field_of(&m, StateId::FREE, 0).unwrap();
            let closure = Closure::new(&exact, &m, StateId::FREE).unwrap();
            assert_eq!(mobility(&exact, &m, &closure).unwrap(), Some(2), "{turned}");
        }
    }
}
