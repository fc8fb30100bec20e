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

mod intersection;
mod rods;

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::Mechanism;
use crate::rank::finite::displacement_group::group_dimension;
use intersection::{Arcs, Class};

/// Number of contour orders tried.
const ORDERS: usize = 6;

/// Returns the highest order that can stop a motion, or `None` if it is unknown.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// A few eliminations of J, and products of classes with as many terms as sets of freedoms are open at a time.
pub(super) fn bound(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    instantaneous: usize,
) -> Result<Option<usize>, ExactError> {
    let freedoms = closure.columns.len();
    let screws = closure.columns.iter().any(|c| c.freedom == Freedom::Screw);
    if screws || !closure.couplings.is_empty() || freedoms > intersection::MOST {
        return Ok(None);
    }
    let arcs: Vec<Arcs> = closure.contours.iter().map(|c| arcs(closure, c)).collect();
    if let Some(order) = rods::bound(exact, mechanism, closure, instantaneous)? {
        return Ok(Some(order));
    }
    if let [alone] = &arcs[..] {
        // All equations, including those that cut further freedoms off, belong to one bundle.
        let inside = alone.count() == freedoms;
        let class = inside.then(|| Class::one().times_all(alone, freedoms));
        return Ok(class.flatten().and_then(|c| c.number(freedoms, 0)));
    }
    let mut dimensions = Vec::new();
    for contour in &closure.contours {
        dimensions.push(group_dimension(exact, mechanism, contour)?);
    }
    let columns = closure.dense(exact);
    let all = arcs.len();
    let mut least = None;
    for first in 0..all.min(ORDERS) {
        let order: Vec<usize> = (0..all).map(|i| (first + i) % all).collect();
        let added = added_rank(exact, closure, &columns, &order);
        let found = highest(
            &arcs,
            &dimensions,
            &order,
            &added,
            freedoms,
            instantaneous - 1,
        );
        least = [least, found].into_iter().flatten().min();
    }
    Ok(least)
}

/// Cuts a contour's columns into two arcs.
fn arcs(closure: &Closure<Residue>, contour: &Contour) -> Arcs {
    let of = |joints: &[_]| {
        let here = |c: &usize| {
            let joint = closure.columns[*c].joint;
            joints.iter().any(|&(j, _)| j == joint)
        };
        (0..closure.columns.len()).filter(here).collect()
    };
    let (one, other) = contour.joints.split_at(contour.joints.len() / 2);
    Arcs::new(of(one), of(other))
}

/// Returns what each contour adds to the rank, in the given order.
fn added_rank(
    exact: &ExactField,
    closure: &Closure<Residue>,
    columns: &[Vec<Residue>],
    order: &[usize],
) -> Vec<usize> {
    let mut span = Echelon::new(exact.field());
    let mut added = vec![0; order.len()];
    for &k in order {
        let before = span.rank();
        for r in closure.dim * k..closure.dim * (k + 1) {
            let row: Vec<Residue> = columns.iter().map(|c| c[r]).collect();
            span.insert(&row);
        }
        added[k] = span.rank() - before;
    }
    added
}

/// Returns the highest order of an equation that is not among those taken. `cut` freedoms are cut off by equations of
/// all t.
fn highest(
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
        let mut class = Some(Class::one());
        for (at, &k) in order.iter().enumerate() {
            let later = order[at + 1..].iter().map(|&l| &arcs[l]);
            let equations = added[k] + usize::from(k == more);
            class = class
                .and_then(|c| c.times_all(&arcs[k], equations))
                .map(|c| c.without_lost(later, freedoms, cut));
        }
        let number = class.and_then(|c| c.number(freedoms, cut));
        highest = highest.zip(number).map(|(a, b)| a.max(b));
    }
    highest
}
