//! Proofs for singular poses: poses without motion, crossings of branches, and cusps in which a branch turns back.
//!
//! J leaves open s equations g(x) = 0 in n free coordinates. Their number s is the dimension of the groups of the
//! contours less the rank of J. To second order they are quadratic forms. If a combination of them is definite, nothing
//! moves, as in a taut chain [Connelly & Whiteley 1996]. At a common zero with independent gradients, a motion of n - s
//! freedoms begins [Avakov 1985; Izmailov & Tretyakov 1994].
//!
//! A single equation has zeros of n - 1 dimensions as soon as it changes its sign. It does so along a line on which it
//! begins with an odd power, which finds cusps. Motions of more freedoms are excluded by power series in a random
//! subspace (`higher_order`).

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{combination, relations};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::Mechanism;
use crate::motion::pose::Pose;
use crate::rank::finite::higher_order::{HigherOrder, Line, ORDER};
use crate::rank::finite::mobility::{Finite, How};
use crate::rank::finite::regular::dimension;
use crate::rank::finite::tangent_cone::{Flat, Quadrics, directions, sparse};

/// Returns the mobility at a pose where not every first-order motion is finite, or `None` if this test does not decide.
/// `stopped` is the order that stops a motion in a random direction.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// O(n²) expansions to second order, and one of a line.
pub(super) fn passed(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
    pose: &Pose,
    series: &HigherOrder,
    stopped: usize,
) -> Result<Option<Finite>, ExactError> {
    let n = closure.columns.len() - rank;
    let flat = Flat::new(pose, Some(n));
    let quadrics = Quadrics::new(pose, &flat);
    if quadrics.is_definite() {
        let (order, motions) = (2, n);
        return Ok(Some(Finite::new(0, How::Stopped { order, motions })));
    }
    let equations = dimension(exact, mechanism, closure)? - rank;
    if equations == 0 || equations >= n {
        return Ok(None);
    }
    let through = |order| Some(Finite::new(n - equations, How::Singular { order }));
    if equations == 1
        && let Some(order) = [Some(stopped), flat_line(series)]
            .into_iter()
            .flatten()
            .find(|order| order % 2 == 1)
    {
        return Ok(through(order));
    }
    let zeros = directions(&quadrics, sparse(&flat.kernel), starts(n));
    let crossing = quadrics.cross(equations, &zeros) && series.isolated(equations).is_some();
    Ok(if crossing { through(2) } else { None })
}

/// Returns the order of the single equation along a line without second-order terms, bent to remove the fourth order if
/// possible. Returns `None` if there is no such line.
fn flat_line(series: &HigherOrder) -> Option<usize> {
    let (field, n) = series.free();
    let kernel = relations(field, &form(series)?);
    let weights: Vec<Residue> = (0..kernel.len()).map(|k| any(field, k)).collect();
    let line = combination(field, &kernel, &weights);
    if line.iter().all(|&x| x == 0) {
        return None;
    }
    let across: Vec<Residue> = (0..n).map(|k| any(field, n + k)).collect();
    let along = |a: Residue| {
        let bent: Vec<Residue> = across.iter().map(|&x| field.mul(a, x)).collect();
        series.bent_line(&line, &bent, ORDER)
    };
    let straight = along(0);
    if straight.stopped != Some(4) {
        return straight.stopped;
    }
    // The fourth order is of second degree in a: c + b a + q a², a square if its discriminant is 0.
    let fourth = |a: Residue| match along(a) {
        Line {
            stopped: Some(4),
            value,
            ..
        } => value,
        _ => 0,
    };
    let (one, two) = (field.one(), field.from_i64(2));
    let (c, plus, minus) = (straight.value, fourth(one), fourth(field.neg(one)));
    let half = field.inv(two);
    let b = field.mul(half, field.sub(plus, minus));
    let q = field.sub(field.mul(half, field.add(plus, minus)), c);
    let square = field.mul(b, b) == field.mul(field.from_i64(4), field.mul(q, c));
    let bent = (q != 0 && square).then(|| field.neg(field.mul(b, field.inv(field.mul(two, q)))));
    bent.map_or(straight.stopped, |a| along(a).stopped)
}

/// Returns twice the matrix of the quadratic form of the single equation, or `None` if it has no second-order terms.
fn form(series: &HigherOrder) -> Option<Vec<Vec<Residue>>> {
    let (field, n) = series.free();
    let unit = |set: &[usize]| -> Vec<Residue> {
        let one = |i: usize| if set.contains(&i) { field.one() } else { 0 };
        (0..n).map(one).collect()
    };
    let single: Vec<Vec<Residue>> = (0..n).map(|i| series.second(&unit(&[i]))).collect();
    // One form for each remaining row; all are multiples of one another.
    let mut forms = vec![vec![vec![0; n]; n]; single.first()?.len()];
    for i in 0..n {
        for j in 0..n {
            let both = if i == j {
                let twice = |&x: &Residue| field.mul(field.from_i64(4), x);
                single[i].iter().map(twice).collect()
            } else {
                series.second(&unit(&[i, j]))
            };
            for (k, form) in forms.iter_mut().enumerate() {
                form[i][j] = field.sub(field.sub(both[k], single[i][k]), single[j][k]);
            }
        }
    }
    let some = |form: &Vec<Vec<Residue>>| form.iter().flatten().any(|&x| x != 0);
    forms.into_iter().find(some)
}

/// Returns numbers unrelated to the geometry.
fn any(field: Field, k: usize) -> Residue {
    field.from_i64(0x2545_f491_4f6c_dd1d_i64.wrapping_mul(2 * k as i64 + 1) >> 2)
}

/// Returns start directions for the search for zeros, spread evenly by the plastic numbers of that many dimensions.
fn starts(n: usize) -> Vec<Vec<f64>> {
    let share = |i: usize, k: usize| {
        let step = 1.0 / 1.220_744_084_6_f64.powi(1 + i32::try_from(k).unwrap_or(0));
        (0.5 + (i + 1) as f64 * step).fract() - 0.5
    };
    (0..40)
        .map(|i| (0..n).map(|k| share(i, k)).collect())
        .collect()
}
