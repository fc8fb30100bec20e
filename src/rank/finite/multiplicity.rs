//! Motions proven by the order up to which nothing stops them.
//!
//! A closed pose with no others near is a solution of polynomial equations, and has a multiplicity of at most what Bézout's theorem
//! allows. That multiplicity is the order that stops a motion in a general direction, or more. So what is not stopped up to that
//! order is never stopped, and every instantaneous motion is one. Coefficients are known modulo a prime near 2^61: one that is 0
//! there is 0 but for a chance of some 10^-18. All bundles here are globally generated, so that what else solves the equations
//! does not count [Fulton 1984, "Intersection Theory", theorem 12.3].

use crate::closure::contour::Contour;
use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{LinkId, Mechanism, Mode};
use crate::rank::finite::displacement_group::{Kind, group_of};

/// Most links whose turns are counted in.
const LINKS: usize = 14;

/// The order beyond which nothing stops a motion; none where that is not known.
///
/// # Errors
/// Where a coordinate has no value in the field.
///
/// # Complexity
/// For pins in a plane O(2^n n) for n links; else nothing to speak of.
pub(super) fn bound(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    instantaneous: usize,
) -> Result<Option<usize>, ExactError> {
    if !closure.couplings.is_empty() {
        return Ok(None);
    }
    Ok(match one_contour(closure) {
        None => pins_in_a_plane(exact, mechanism, closure, instantaneous)?,
        bound => bound,
    })
}

/// A single contour of hinges and slides, cut into two arcs of a and b freedoms.
///
/// With t = tan θ/2 of each hinge, and each slide as it is, the displacement along an arc is a dual quaternion linear in every t,
/// and the contour is closed where those of the arcs are proportional, A(s) μ = B(t) λ: eight equations of one line bundle over
/// s, t and (λ : μ), whose self-intersection is a! b!. That is 4 for Bennett's linkage and 36 for six hinges.
fn one_contour(closure: &Closure<Residue>) -> Option<usize> {
    let [contour] = &closure.contours[..] else {
        return None;
    };
    let inside = closure
        .columns
        .iter()
        .all(|c| contour.direction(c.joint).is_some() && c.freedom != Freedom::Screw);
    let n = closure.columns.len();
    let factorial = |n: usize| (1..=n).try_fold(1usize, usize::checked_mul);
    factorial(n / 2)?
        .checked_mul(factorial(n.div_ceil(2))?)
        .filter(|_| inside)
}

/// Contours of pins in a plane.
///
/// With z = e^iθ of each link, a contour closes where Σ a z = 0 and Σ ā / z = 0 over its links: two equations linear in each of
/// its z. Of all of them some that are independent at the pose have a manifold of solutions, and each other one restricted to
/// it vanishes there or has, at the pose, a zero of an order of at most the number of ways to give each equation a z of its own,
/// a permanent. Further freedoms are cut off by equations of all z.
fn pins_in_a_plane(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    instantaneous: usize,
) -> Result<Option<usize>, ExactError> {
    let single = closure.columns.windows(2).all(|c| c[0].joint != c[1].joint);
    if !single || !closure.columns.iter().all(|c| c.freedom.turns()) {
        return Ok(None);
    }
    let joints = closure.columns.iter().map(|c| c.joint);
    let rows = match mechanism.mode {
        Mode::Planar { .. } => closure.clone(),
        Mode::Spatial => {
            let group = group_of(exact, mechanism, joints)?;
            if group.kind() != Kind::Planar {
                return Ok(None);
            }
            group.rows_of(closure)
        }
    };
    let mut links: Vec<LinkId> = rows.contours.iter().flat_map(|c| c.links.clone()).collect();
    links.sort_unstable();
    links.dedup();
    // One link stands still, whichever.
    let Some(n) = links.len().checked_sub(1).filter(|&n| n <= LINKS) else {
        return Ok(None);
    };
    let of = |c: &Contour| {
        let places = c
            .links
            .iter()
            .filter_map(|l| links[..n].binary_search(l).ok());
        places.fold(0u32, |set, p| set | 1 << p)
    };
    let sets: Vec<u32> = rows.contours.iter().map(of).collect();
    let added = added_rank(exact, closure, &rows);
    let mut system: Vec<u32> = Vec::new();
    for (&set, &rank) in sets.iter().zip(&added) {
        system.extend(std::iter::repeat_n(set, rank));
    }
    system.extend(std::iter::repeat_n((1 << n) - 1, instantaneous - 1));
    if system.len() + 1 != n {
        return Ok(None);
    }
    let left = sets.iter().zip(&added).filter(|(_, rank)| **rank < 2);
    let bounds = left.map(|(&set, _)| permanent(&[&system[..], &[set]].concat(), n));
    Ok(bounds.max())
}

/// What each contour in its turn adds to the rank, with its rows in the plane, once the angles of all are known to close.
fn added_rank(
    exact: &ExactField,
    closure: &Closure<Residue>,
    rows: &Closure<Residue>,
) -> Vec<usize> {
    let row_of = |columns: &[Vec<Residue>], r: usize| -> Vec<Residue> {
        columns.iter().map(|c| c[r]).collect()
    };
    // All turn about one direction, so that any component of it that is not 0 is the angle.
    let first = closure.columns.first();
    let turn = first.and_then(|c| c.twist.iter().position(|&x| x != 0));
    let mut span = Echelon::new(exact.field());
    let (whole, plane) = (closure.dense(exact), rows.dense(exact));
    for k in 0..closure.contours.len() {
        span.insert(&row_of(&whole, closure.dim * k + turn.unwrap_or(0)));
    }
    let contours = 0..rows.contours.len();
    let added = contours.map(|k| {
        let before = span.rank();
        for r in rows.dim * k..rows.dim * (k + 1) {
            span.insert(&row_of(&plane, r));
        }
        span.rank() - before
    });
    added.collect()
}

/// In how many ways each set can be given an element of its own, of as many as there are sets.
fn permanent(sets: &[u32], n: usize) -> usize {
    let mut ways = vec![0usize; 1 << n];
    ways[0] = 1;
    for taken in 0..1usize << n {
        let Some(&set) = sets.get(taken.count_ones() as usize) else {
            continue;
        };
        for p in (0..n).filter(|p| set >> p & 1 == 1 && taken >> p & 1 == 0) {
            let with = taken | 1 << p;
            ways[with] = ways[with].saturating_add(ways[taken]);
        }
    }
    ways[(1 << n) - 1]
}

#[cfg(test)]
mod tests {
    use super::permanent;

    #[test]
    fn permanents_count_by_hand() {
        // Three rods and a coupler: two contours of rod, coupler, rod.
        assert_eq!(permanent(&[0b0111, 0b0111, 0b1110, 0b1110], 4), 8);
        assert_eq!(permanent(&[0b111; 3], 3), 6);
        assert_eq!(permanent(&[0b001, 0b001, 0b110], 3), 0);
    }
}
