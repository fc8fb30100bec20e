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
use crate::closure::tree::spanning_forest;
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::rigid::split_twist;
use crate::linalg::echelon::{Echelon, linear_combination, linear_relations, rank_of};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{LinkId, Mechanism, Mode};
use crate::rank::finite::displacement_group::{is_group, passed_twists};

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
    fn from_group(basis: Vec<Twist>) -> BondPart {
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

/// Returns the finite mobility of the joints of a closure by groups only. `None` if they do not reduce to single joints.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// O(p²) products of algebras for p freedoms.
pub fn mobility_by_bonds(
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
        let passed = passed_twists(exact, mechanism, j)?;
        chains.push(Chain {
            ends: mechanism.joints[j].links,
            parts: passed
                .into_iter()
                .map(|(_, t)| BondPart::from_group(vec![t]))
                .collect(),
        });
    }
    let mut bonds = Bonds {
        exact,
        chains,
        mobility: 0,
    };
    let links: Vec<LinkId> = mechanism.link_ids().collect();
    while bonds.join_chains(&links)
        || bonds.replace_parallelogram()
        || bonds.merge_neighbours()
        || bonds.close_chain()
        || bonds.side_by_side()
        || bonds.narrow_groups()
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
    fn join_chains(&mut self, links: &[LinkId]) -> bool {
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
    fn merge_neighbours(&mut self) -> bool {
        for c in 0..self.chains.len() {
            let chain = &self.chains[c];
            let (n, closed) = (chain.parts.len(), chain.is_closed());
            for length in (2..=n.saturating_sub(usize::from(closed))).rev() {
                for from in 0..if closed { n } else { n + 1 - length } {
                    let mut turned = chain.parts.clone();
                    turned.rotate_left(from);
                    let (part, rest) = turned.split_at(length);
                    let Some(group) = self.spanned_algebra(part) else {
                        continue;
                    };
                    let all: usize = part.iter().map(|p| p.span.len()).sum();
                    self.mobility += all - group.len();
                    let mut parts = vec![BondPart::from_group(group)];
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
    fn close_chain(&mut self) -> bool {
        let Some(c) = self.chains.iter().position(|c| {
            c.is_closed() && c.parts.len() <= 2 && c.parts.iter().all(BondPart::is_group)
        }) else {
            return false;
        };
        let chain = self.chains.remove(c);
        if let [a, b] = &chain.parts[..] {
            self.mobility += intersect_spans(self.exact, &a.span, &b.span).len();
        }
        true
    }

    /// Replaces the first two chains between the same links for which `merged` returns parts by one chain with these parts.
    fn merge_parallel(
        &mut self,
        merged: impl Fn(&Self, &Chain, &Chain) -> Option<Vec<BondPart>>,
    ) -> bool {
        for b in 0..self.chains.len() {
            for a in 0..b {
                let (one, other) = (&self.chains[a], self.chains[b].clone());
                let same_way = other.ends == one.ends;
                let other = if same_way { other } else { other.reversed() };
                if other.ends == one.ends
                    && !one.is_closed()
                    && let Some(parts) = merged(self, one, &other)
                {
                    self.chains[a].parts = parts;
                    self.chains.remove(b);
                    return true;
                }
            }
        }
        false
    }

    /// Replaces two single groups between the same links by their intersection.
    fn side_by_side(&mut self) -> bool {
        let single = |c: &Chain| c.parts.len() <= 1 && c.parts.iter().all(BondPart::is_group);
        self.merge_parallel(|bonds, x, y| {
            let both = || match (&x.parts[..], &y.parts[..]) {
                ([a], [b]) => Some(intersect_spans(bonds.exact, &a.span, &b.span)),
                _ => None,
            };
            (single(x) && single(y)).then(|| both().map(BondPart::from_group).into_iter().collect())
        })
    }

    /// Returns the algebra that some parts span together, if the span is an algebra and contains all their
    /// displacements.
    fn spanned_algebra(&self, parts: &[BondPart]) -> Option<Vec<Twist>> {
        let mut span = Echelon::new(self.exact.field());
        let mut basis: Vec<&Twist> = Vec::new();
        for t in parts.iter().flat_map(|p| &p.span) {
            if span.insert(t) {
                basis.push(t);
            }
        }
        let inside = |p: &BondPart| p.within.iter().all(|t| span.contains(t));
        let group = parts.iter().all(inside) && is_group(self.exact, &basis);
        group.then(|| basis.into_iter().cloned().collect())
    }
}

/// Returns a basis of the intersection of two spans, each given by independent vectors.
pub(in crate::rank) fn intersect_spans(exact: &ExactField, a: &[Twist], b: &[Twist]) -> Vec<Twist> {
    let field = exact.field();
    let both: Vec<Twist> = a.iter().chain(b).cloned().collect();
    let relations = linear_relations(field, &both);
    let of_first = |factors: &Vec<Residue>| linear_combination(field, a, &factors[..a.len()]);
    relations.iter().map(of_first).collect()
}

impl Bonds<'_> {
    /// Replaces two bars of a parallelogram by one part that slides on a circle.
    fn replace_parallelogram(&mut self) -> bool {
        self.merge_parallel(|bonds, a, b| Some(vec![bonds.circular_slide(a, b)?]))
    }

    /// Returns the slide on a circle of two chains between the same links that are bars of a parallelogram.
    fn circular_slide(&self, a: &Chain, b: &Chain) -> Option<BondPart> {
        let [near, far] = self.hinge_twists(a)?;
        let [near_too, far_too] = self.hinge_twists(b)?;
        let field = self.exact.field();
        let difference = |x: &Twist, y: &Twist| -> Twist {
            x.iter().zip(y).map(|(&x, &y)| field.sub(x, y)).collect()
        };
        let (along, across) = (difference(&near, &far), difference(&near, &near_too));
        // The axes must be parallel, the bars equal, and the points not all on a line.
        let slides = |t: &Twist| t[..3].iter().all(|&x| x == 0);
        let equal = along == difference(&near_too, &far_too);
        let apart = rank_of(field, [&along[..], &across[..]]) == 2;
        (slides(&along) && slides(&across) && equal && apart).then(|| BondPart {
            span: vec![along.clone()],
            within: vec![along, across],
        })
    }

    /// Returns the twists of a chain of two hinges about parallel axes, with the same angular velocity.
    fn hinge_twists(&self, chain: &Chain) -> Option<[Twist; 2]> {
        let [first, second] = &chain.parts[..] else {
            return None;
        };
        let field = self.exact.field();
        let turn = |part: &BondPart| -> Option<Twist> {
            let [twist] = &part.span[..] else {
                return None;
            };
            let (w, v) = split_twist(twist);
            let of = w.into_iter().find(|&x| x != 0)?;
            let hinge = part.is_group() && self.exact.dot(w, v) == 0;
            let scale = field.inv(of);
            hinge.then(|| twist.iter().map(|&x| field.mul(scale, x)).collect())
        };
        Some([turn(first)?, turn(second)?])
    }

    /// Restricts groups of which every instantaneous motion uses only a subgroup.
    fn narrow_groups(&mut self) -> bool {
        let motions = linear_relations(self.exact.field(), &self.closure_columns());
        let mut narrowed = false;
        let mut at = 0;
        for c in 0..self.chains.len() {
            let mut kept = Vec::new();
            for part in self.chains[c].parts.clone() {
                let width = part.span.len();
                let used = self.used_twists(&part, motions.iter().map(|m| &m[at..at + width]));
                at += width;
                let fewer = used.len() < width && (part.is_group() || used.is_empty());
                if fewer && is_group(self.exact, &used) {
                    narrowed = true;
                    if !used.is_empty() {
                        kept.push(BondPart::from_group(used));
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
    fn used_twists<'a>(
        &self,
        part: &BondPart,
        motions: impl Iterator<Item = &'a [Residue]>,
    ) -> Vec<Twist> {
        let field = self.exact.field();
        let mut span = Echelon::new(field);
        motions
            .map(|weights| linear_combination(field, &part.span, weights))
            .filter(|t| span.insert(t))
            .collect()
    }

    /// Returns the columns of the closure matrix of the chains: six rows for each chain outside a spanning forest.
    fn closure_columns(&self) -> Vec<Vec<Residue>> {
        let field = self.exact.field();
        let links = self.chains.iter().map(|c| c.ends.map(LinkId::index));
        let nodes = links.clone().flatten().max().map_or(0, |l| l + 1);
        let starts = links.clone().map(|ends| ends[0]);
        // For each link, the chains from a root to it, each with its direction of passage.
        let mut paths: Vec<Vec<(usize, i32)>> = vec![Vec::new(); nodes];
        let mut closing: Vec<usize> = (0..self.chains.len()).collect();
        for step in spanning_forest(nodes, links, |_| false, starts).1 {
            let sign = if step.forward { 1 } else { -1 };
            paths[step.link] = [&paths[step.from][..], &[(step.joint, sign)]].concat();
            closing.retain(|&c| c != step.joint);
        }
        let mut columns = Vec::new();
        for (c, chain) in self.chains.iter().enumerate() {
            let signs: Vec<i32> = closing
                .iter()
                .map(|&k| {
                    let [from, to] = self.chains[k].ends;
                    let of = |l: LinkId| paths[l].iter().find(|p| p.0 == c).map_or(0, |p| p.1);
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{draw_mechanism, hinges};
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
            let m = draw_mechanism(&hinges(&(0..6).map(pair).collect::<Vec<_>>()), &[]);
            let exact = field_of(&m, StateId::FREE, 0).unwrap();
            let closure = Closure::new(&exact, &m, StateId::FREE).unwrap();
            assert_eq!(
                mobility_by_bonds(&exact, &m, &closure).unwrap(),
                Some(2),
                "{turned}"
            );
        }
    }
}
