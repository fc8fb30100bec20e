//! Singular poses, proven: where nothing moves, where branches cross, and where one turns back in a cusp.
//!
//! What J leaves open are s equations g(x) = 0 in n free coordinates, as many as the groups of the contours have dimensions more
//! than J has rank. To second order they are quadratic forms. Where a combination of them is definite nothing moves, as in a chain
//! that is taut [Connelly & Whiteley 1996]. At a common zero of these where their gradients are independent
//! a motion of n - s freedoms begins [Avakov 1985; Izmailov & Tretyakov 1994]. One equation alone has zeros of n - 1 dimensions
//! as soon as it changes its sign, as it does along a line on which it begins with an odd power: that finds cusps. What
//! stops motions of more freedoms are power series in a random subspace (`higher_order`).

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

/// The mobility at a pose where not everything that moves at first order moves; none where this does not decide. `stopped` is the
/// order that stops a motion in a random direction.
///
/// # Errors
/// Where a coordinate has no value in the field.
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

/// The order of the one equation along a line on which it has nothing of second order, bent where that takes away the fourth;
/// none where there is no such line.
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
    // What the fourth order has is of second degree in a: c + b a + q a², a square where its discriminant is 0.
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

/// Twice the matrix of the quadratic form of the one equation; none where it has nothing of second order.
fn form(series: &HigherOrder) -> Option<Vec<Vec<Residue>>> {
    let (field, n) = series.free();
    let unit = |set: &[usize]| -> Vec<Residue> {
        let one = |i: usize| if set.contains(&i) { field.one() } else { 0 };
        (0..n).map(one).collect()
    };
    let single: Vec<Vec<Residue>> = (0..n).map(|i| series.second(&unit(&[i]))).collect();
    // One of each row that is left; all are multiples of one another.
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

/// Numbers that the geometry does not know.
fn any(field: Field, k: usize) -> Residue {
    field.from_i64(0x2545_f491_4f6c_dd1d_i64.wrapping_mul(2 * k as i64 + 1) >> 2)
}

/// Directions to look for zeros from: spread evenly by the plastic numbers of as many dimensions.
fn starts(n: usize) -> Vec<Vec<f64>> {
    let share = |i: usize, k: usize| {
        let step = 1.0 / 1.220_744_084_6_f64.powi(1 + i32::try_from(k).unwrap_or(0));
        (0.5 + (i + 1) as f64 * step).fract() - 0.5
    };
    (0..40)
        .map(|i| (0..n).map(|k| share(i, k)).collect())
        .collect()
}
