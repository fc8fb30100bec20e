//! Motions proven by an order up to which nothing stops them.
//!
//! A closed pose with no others near it is a solution of polynomial equations, and Bézout's theorem bounds its
//! multiplicity. That multiplicity is at least the order that stops a motion in a general direction. So a motion that
//! is not stopped up to that order is never stopped, and every instantaneous motion is finite.
//!
//! Coefficients are known modulo a prime above 2^61. A coefficient that is 0 there is 0 except with a chance of about
//! 10^-18. All bundles here are globally generated, so that other solutions of the equations do not count [Fulton 1984,
//! "Intersection Theory", theorem 12.3].
//!
//! With t = tan θ/2 for each hinge, and each slide unchanged, the displacement along an arc is a dual quaternion linear
//! in every t. A contour, cut into two arcs, is closed if those of the arcs are proportional, A(s) μ = B(t) λ. These
//! are equations of one line bundle over s, t and (λ : μ). With S and T the sums of the classes of the t of either arc,
//! r + 1 of them meet in the class Σ S^i T^j over i + j = r. No t can be used twice.
//!
//! From every contour, as many equations are taken as it adds to the rank. This leaves a curve once further freedoms
//! are cut off. Any other equation either vanishes on the curve or has a zero at the pose. The order of that zero is at
//! most what this equation and those taken allow. That is 4 for Bennett's linkage and 36 for six hinges.
//!
//! A platform may stand on rods that end in balls.
//!
//! Its displacements are the points of Study's quadric in seven dimensions, and each rod keeps it on another quadric
//! [Husty 1996]. So the poses that 6 - n of them allow meet n - 1 hyperplanes and one more quadric in at most 2^(8 - n)
//! points.
//!
//! Suppose the closed poses of a single contour form a manifold with as many dimensions as move at first order. Among
//! all coordinates its codimension is then the rank of the contour. Manifolds whose ranks add up to that of J meet
//! transversally. So the poses that close all contours also form a manifold, of dimension f - rank J.

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{Echelon, transpose};
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism};
use crate::rank::exact::modular::ExactState;
use crate::rank::finite::displacement_group::{group_dimension, spatial_twists};
use crate::rank::finite::higher_order::{HigherOrder, Line, ORDER};
use crate::rank::finite::independent_parts::with_joints_only;
use crate::rank::finite::mobility::prove_regular;

/// Number of contour orders tried.
const ORDERS: usize = 6;

/// Returns the highest order that can stop a motion. `None` if it is unknown.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// A few eliminations of J, and products of classes. A product has as many terms as sets of freedoms are open at a time.
fn highest_order(at: &ExactState<'_>) -> Result<Option<usize>, ExactError> {
    let (exact, closure) = (at.exact, &*at.closure);
    let freedoms = closure.columns.len();
    let screws = closure.columns.iter().any(|c| c.freedom == Freedom::Screw);
    if screws || !closure.couplings.is_empty() || freedoms > MOST {
        return Ok(None);
    }
    let arcs: Vec<Arcs> = closure
        .contours
        .iter()
        .map(|c| cut_into_arcs(closure, c))
        .collect();
    if let Some(order) = bound_of_rods(at)? {
        return Ok(Some(order));
    }
    if let [alone] = &arcs[..] {
        // All equations, including those that cut further freedoms off, belong to one bundle.
        let inside = alone.iter().map(Vec::len).sum::<usize>() == freedoms;
        let class = inside.then(|| Class::unit_class().times_all(alone, freedoms));
        return Ok(class
            .flatten()
            .and_then(|c| c.intersection_number(freedoms, 0)));
    }
    let mut dimensions = Vec::new();
    for contour in &closure.contours {
        dimensions.push(group_dimension(exact, at.mechanism, contour)?);
    }
    let rows = transpose(&closure.dense_columns(exact));
    let all = arcs.len();
    let mut least = None;
    for first in 0..all.min(ORDERS) {
        let order: Vec<usize> = (0..all).map(|i| (first + i) % all).collect();
        let added = added_rank(exact, closure.dim, &rows, &order);
        let found = highest_of_equations(
            &arcs,
            &dimensions,
            &order,
            &added,
            freedoms,
            at.mobility() - 1,
        );
        least = [least, found].into_iter().flatten().min();
    }
    Ok(least)
}

/// Cuts a contour's columns into two arcs.
fn cut_into_arcs(closure: &Closure<Residue>, contour: &Contour) -> Arcs {
    let of = |joints: &[_]| {
        let here = |c: &usize| {
            let joint = closure.columns[*c].joint;
            joints.iter().any(|&(j, _)| j == joint)
        };
        (0..closure.columns.len()).filter(here).collect()
    };
    let (one, other) = contour.joints.split_at(contour.joints.len() / 2);
    [of(one), of(other)]
}

/// Returns what each contour adds to the rank, in the given order.
fn added_rank(
    exact: &ExactField,
    dim: usize,
    rows: &[Vec<Residue>],
    order: &[usize],
) -> Vec<usize> {
    let mut span = Echelon::new(exact.field());
    let mut added = vec![0; order.len()];
    for &k in order {
        let own = rows[dim * k..dim * (k + 1)].iter();
        added[k] = own.filter(|row| span.insert(row)).count();
    }
    added
}

/// Returns the highest order of an equation that is not among those taken. `cut` freedoms are cut off by equations of
/// all t.
fn highest_of_equations(
    arcs: &[Arcs],
    dimensions: &[usize],
    order: &[usize],
    added: &[usize],
    freedoms: usize,
    cut: usize,
) -> Option<usize> {
    let left = order.iter().filter(|&&k| added[k] < dimensions[k]);
    let mut highest = Some(0);
    for &more in left {
        let mut class = Some(Class::unit_class());
        for (at, &k) in order.iter().enumerate() {
            let later = order[at + 1..].iter().map(|&l| &arcs[l]);
            let equations = added[k] + usize::from(k == more);
            class = class
                .and_then(|c| c.times_all(&arcs[k], equations))
                .map(|c| c.without_lost(later, freedoms, cut));
        }
        let number = class.and_then(|c| c.intersection_number(freedoms, cut));
        highest = highest.zip(number).map(|(a, b)| a.max(b));
    }
    highest
}

/// Maximum number of freedoms.
const MOST: usize = 64;
/// Maximum number of terms of a class.
const TERMS: usize = 100_000;

/// The two arcs of a contour, each a set of freedoms.
type Arcs = [Vec<usize>; 2];

/// A class: the multiplicity of each product of different h, by their sets.
#[derive(Debug, Clone)]
struct Class(Vec<(u64, usize)>);

impl Class {
    fn unit_class() -> Class {
        Class(vec![(0, 1)])
    }

    /// Merges equal products and adds their multiplicities.
    fn collect_terms(mut terms: Vec<(u64, usize)>) -> Class {
        terms.sort_unstable_by_key(|t| t.0);
        terms.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 = kept.1.saturating_add(next.1);
            }
            same
        });
        Class(terms)
    }

    /// Multiplies by a sum of h.
    fn times_sum(&self, sum: &[usize]) -> Class {
        let mut terms = Vec::with_capacity(self.0.len() * sum.len());
        for &(set, often) in &self.0 {
            let others = sum.iter().filter(|&&v| set >> v & 1 == 0);
            terms.extend(others.map(|&v| (set | 1 << v, often)));
        }
        Class::collect_terms(terms)
    }

    /// Multiplies by Σ S^i T^j over i + j = n, with S and T the sums over two arcs. Returns `None` if the result has
    /// too many terms.
    fn times_all(self, arcs: &Arcs, n: usize) -> Option<Class> {
        // With P_n that product, P_n = S P_(n - 1) + T^n P_0.
        let mut other = self.clone();
        let mut all = self;
        for _ in 0..n {
            other = other.times_sum(&arcs[1]);
            all = Class::collect_terms([all.times_sum(&arcs[0]).0, other.0.clone()].concat());
            if all.0.len() > TERMS {
                return None;
            }
        }
        Some(all)
    }

    /// Removes the products that lack more than `cut` freedoms of no later arc.
    fn without_lost<'a>(
        mut self,
        later: impl Iterator<Item = &'a Arcs>,
        freedoms: usize,
        cut: usize,
    ) -> Class {
        let open = later.flatten().flatten();
        let open = open.fold(0, |set, &v| set | 1 << v);
        let gone = all_freedoms(freedoms) & !open;
        self.0
            .retain(|(set, _)| (gone & !set).count_ones() as usize <= cut);
        self
    }

    /// Returns the number of points in common with `cut` general classes of all h, or `None` if it is too large.
    fn intersection_number(&self, freedoms: usize, cut: usize) -> Option<usize> {
        let missing = |set: u64| (all_freedoms(freedoms) & !set).count_ones() as usize;
        let terms = self.0.iter().filter(|(set, _)| missing(*set) == cut);
        let sum = terms.fold(0usize, |sum, (_, often)| sum.saturating_add(*often));
        let ways = (1..=cut).fold(sum, usize::saturating_mul);
        (ways < usize::MAX).then_some(ways)
    }
}

fn all_freedoms(freedoms: usize) -> u64 {
    u64::MAX >> (64 - freedoms.max(1))
}

/// Returns the highest order that can stop a platform on rods, or `None` for other mechanisms.
fn bound_of_rods(at: &ExactState<'_>) -> Result<Option<usize>, ExactError> {
    let (mechanism, state) = (at.mechanism, at.closure.state);
    let (mut rods, mut bodies) = (0, 0);
    for link in mechanism.link_ids() {
        let joints: Vec<JointId> = mechanism.joints_at(link, state).collect();
        match joints[..] {
            [] => {}
            [a, b] if is_rod(at.exact, mechanism, [a, b])? => rods += 1,
            _ => bodies += 1,
        }
    }
    let platform = bodies == 2 && mechanism.joints_in(state).count() == 2 * rods;
    let power = u32::try_from(at.mobility()).ok();
    let power = power.and_then(|n| 8u32.checked_sub(n)).filter(|_| platform);
    Ok(power.map(|p| 1 << p))
}

/// Returns true if two joints turn about one point each, so that a link between them only keeps those points at a fixed
/// distance.
fn is_rod(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: [JointId; 2],
) -> Result<bool, ExactError> {
    let mut twists = Vec::new();
    for j in joints {
        let freedoms = mechanism.joints[j].joint_type.freedoms();
        if !freedoms.iter().all(|f| f.is_turn()) {
            return Ok(false);
        }
        twists.extend(spatial_twists(exact, mechanism, j)?);
    }
    Ok(twists.len() == 5 && Echelon::from_vectors(exact.field(), twists).rank() == 5)
}

/// Maximum order of the expansion of a motion.
const HIGHEST: usize = 600;

/// The power series of a pose, and one motion of it.
pub(super) struct Expanded {
    /// `None` if the mechanism is too large.
    pub(super) series: Option<HigherOrder>,
    /// A motion in a random direction.
    pub(super) line: Option<Line>,
    /// The highest order that can stop it.
    bound: Option<usize>,
}

impl Expanded {
    pub(super) fn new(at: &ExactState<'_>) -> Result<Expanded, ExactError> {
        let series = HigherOrder::new(at.exact, at.mechanism, &at.closure, at.rank)?;
        let bound = highest_order(at)?.filter(|&order| order <= HIGHEST);
        let order = bound.unwrap_or(0).max(ORDER);
        let line = series.as_ref().map(|s| s.random_line(order));
        Ok(Expanded {
            series,
            line,
            bound,
        })
    }

    /// Returns true if the motion continues beyond every possible obstruction, so that every instantaneous motion is
    /// finite.
    pub(super) fn is_never_stopped(&self) -> bool {
        matches!((self.line, self.bound), (Some(line), Some(bound)) if line.stopped.is_none() && line.order >= bound)
    }
}

/// Returns true if every contour without the others is at a regular pose of its motion. No contour may duplicate
/// constraints of others.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One proof per contour, if their ranks add up to that of J.
pub(super) fn are_apart(at: &ExactState<'_>) -> Result<bool, ExactError> {
    let closure = &at.closure;
    if closure.contours.len() < 2 || !closure.couplings.is_empty() {
        return Ok(false);
    }
    let part = |contour: &Contour| {
        let joints: Vec<_> = contour.joints.iter().map(|&(j, _)| j).collect();
        with_joints_only(at.mechanism, &joints)
    };
    let parts: Vec<Mechanism> = closure.contours.iter().map(part).collect();
    let each = parts.iter();
    let each = each.map(|part| ExactState::new(at.exact, part, closure.state));
    let each: Vec<ExactState<'_>> = each.collect::<Result<_, _>>()?;
    if each.iter().map(|own| own.rank).sum::<usize>() != at.rank {
        return Ok(false);
    }
    for own in &each {
        if prove_regular(own)?.is_none() && !Expanded::new(own)?.is_never_stopped() {
            return Ok(false);
        }
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two arcs of n hinges each, closed by as many equations as they have: n! n!.
    #[test]
    fn numbers_by_hand() {
        for (n, expected) in [(1, 1), (2, 4), (3, 36), (4, 576)] {
            let arcs = [(0..n).collect(), (n..2 * n).collect()];
            let class = Class::unit_class().times_all(&arcs, 2 * n).unwrap();
            assert_eq!(class.intersection_number(2 * n, 0), Some(expected));
        }
        // A curve of four hinges cut by the sum of all t: (S² T + S T²)(S + T) = 2 S² T², and S² = T² = 2 of two h each.
        let arcs = [vec![0, 1], vec![2, 3]];
        let class = Class::unit_class().times_all(&arcs, 3).unwrap();
        assert_eq!(class.intersection_number(4, 1), Some(8));
        let none = class.without_lost(std::iter::empty(), 4, 0);
        assert_eq!(none.intersection_number(4, 1), Some(0));
    }
}
