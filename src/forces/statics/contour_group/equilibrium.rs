//! The twelve equilibrium equations of the four-link group with a closed contour: by LU in double precision, and exactly.

use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::kinetostatics::Worth;
use crate::statics::pose::{length, minus};
use crate::statics::{condition_number, greatest_abs};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};
use ozols_dense::Matrix;
use std::ops::{Mul, Sub};

/// The two links of each of D, F, K, M, L: the first bears the unknown, the second (if in the group) its opposite.
const ENDS: [(usize, Option<usize>); 5] = [
    (0, None),
    (1, Some(0)),
    (2, Some(0)),
    (1, Some(3)),
    (2, Some(3)),
];

/// Returns the equations with moments about `origins`, in some number system: rows of 12 coefficients and the right
/// side. The unknowns are the components at D, F, K, M, L, then the guide's reaction and its moment about D.
fn equilibrium_rows<N>(
    g: &GroupPose,
    number: impl Fn(f64) -> N,
    origins: [[f64; 2]; 4],
) -> Vec<Vec<N>>
where
    N: Clone + Sub<Output = N> + Mul<Output = N>,
{
    let zero = || number(0.0);
    let mut rows = vec![vec![zero(); 13]; 12];
    let minus = |a: &N, b: &N| a.clone() - b.clone();
    let vector = |p: [f64; 2]| p.map(&number);
    let arm = |p: [f64; 2], link: usize| {
        let ([x, y], [u, v]) = (vector(p), vector(origins[link]));
        [minus(&x, &u), minus(&y, &v)]
    };
    for (j, (point, (first, second))) in [g.d, g.f, g.k, g.m, g.l].into_iter().zip(ENDS).enumerate()
    {
        for (link, sign) in [(Some(first), 1.0), (second, -1.0)] {
            let Some(link) = link else { continue };
            let [x, y] = arm(point, link);
            rows[3 * link][2 * j] = number(sign);
            rows[3 * link + 1][2 * j + 1] = number(sign);
            rows[3 * link + 2][2 * j] = number(-sign) * y;
            rows[3 * link + 2][2 * j + 1] = number(sign) * x;
        }
    }
    // The guide: a force at D along the normal, and a couple.
    let [nx, ny] = vector(g.guide_normal());
    let [x, y] = arm(g.d, 3);
    rows[9][10] = nx.clone();
    rows[10][10] = ny.clone();
    rows[11][10] = x * ny - y * nx;
    rows[11][11] = number(1.0);
    for load in &g.loads {
        let [fx, fy] = vector(load.force);
        let [x, y] = arm(load.point, load.body);
        let row = 3 * load.body;
        rows[row][12] = minus(&rows[row][12], &fx);
        rows[row + 1][12] = minus(&rows[row + 1][12], &fy);
        let turn = x * fy - y * fx;
        rows[row + 2][12] = minus(&minus(&rows[row + 2][12], &turn), &number(load.moment));
    }
    rows
}

fn reactions_of(x: &[f64], arm: f64) -> GroupReactions {
    let at = |j: usize| [x[2 * j], x[2 * j + 1]];
    GroupReactions {
        d: at(0),
        f: at(1),
        k: at(2),
        m: at(3),
        l: at(4),
        guide: x[10],
        guide_moment: x[11],
        arm,
    }
}

/// Returns the reactions by LU with partial pivoting, with their reliability, or `None` if the equations are singular.
#[must_use]
pub fn solve_equilibrium(g: &GroupPose) -> Option<(GroupReactions, Worth)> {
    let size = [g.f, g.k, g.m, g.l]
        .map(|p| length(minus(p, g.d)))
        .into_iter()
        .fold(0.0, f64::max);
    let mut rows = equilibrium_rows(g, |x| x, [g.d, g.m, g.l, g.m]);
    for (r, row) in rows.iter_mut().enumerate() {
        // The couple is scaled to a force at the group's size, and so are moments.
        row[11] *= size;
        if r % 3 == 2 {
            row.iter_mut().for_each(|c| *c /= size);
        }
    }
    let right: Vec<f64> = rows.iter_mut().filter_map(Vec::pop).collect();
    let matrix = Matrix::from_fn(12, 12, |r, c| rows[r][c]);
    let mut x = ozols_dense::solve(&matrix, &right);
    if !x.iter().all(|v| v.is_finite()) {
        return None;
    }
    let found = matrix.times(&Matrix::from_column(&x));
    let left: Vec<f64> = (0..12).map(|r| found[(r, 0)] - right[r]).collect();
    let load = greatest_abs(&right);
    x[11] *= size;
    let worth = Worth {
        condition: condition_number(&matrix),
        residual: if load > 0.0 {
            greatest_abs(&left) / load
        } else {
            0.0
        },
    };
    Some((reactions_of(&x, x[11] / x[10]), worth))
}

/// Returns the reactions in rational arithmetic, with every number of the pose taken exactly, then rounded. Returns
/// `None` if the equations are singular or a number is not finite.
///
/// # Complexity
/// O(12³) operations on whole numbers that grow to about a thousand bits.
#[must_use]
pub fn solve_exactly(g: &GroupPose) -> Option<GroupReactions> {
    let numbers = g
        .loads
        .iter()
        .flat_map(|l| [l.point[0], l.point[1], l.force[0], l.force[1], l.moment]);
    let points = [g.d, g.f, g.k, g.m, g.l, g.guide].into_iter().flatten();
    if !numbers.chain(points).all(f64::is_finite) {
        return None;
    }
    let number = |x: f64| BigRational::from_float(x).unwrap_or_else(BigRational::zero);
    let rows = equilibrium_rows(g, number, [[0.0; 2]; 4]);
    // Doubles are whole numbers over powers of two, so rows can be scaled to whole numbers. Fraction-free Gauss-Jordan
    // elimination (Bareiss) preserves this, and leaves the determinant on the diagonal.
    let mut rows: Vec<Vec<BigInt>> = rows.iter().map(|row| whole_row(row)).collect();
    let mut last = BigInt::one();
    for c in 0..12 {
        let pivot = (c..12).filter(|&r| !rows[r][c].is_zero());
        let best = pivot.min_by_key(|&r| rows[r][c].bits())?;
        rows.swap(c, best);
        let top = rows[c].clone();
        for (r, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != c) {
            let factor = row[c].clone();
            // Cleared columns are zero except for the diagonal, which is scaled along with the rest.
            let first = if r < c { r } else { c };
            for (x, t) in row.iter_mut().zip(&top).skip(first) {
                *x = (&*x * &top[c] - &factor * t) / &last;
            }
        }
        last = top[c].clone();
    }
    let over = |r: usize, by: &BigInt| {
        let ratio = BigRational::new_raw(rows[r][12].clone(), by.clone());
        ratio.to_f64().unwrap_or(f64::NAN)
    };
    let x: Vec<f64> = (0..12).map(|r| over(r, &rows[r][r])).collect();
    let arm = if rows[10][12].is_zero() {
        f64::INFINITY
    } else {
        over(11, &rows[10][12])
    };
    Some(reactions_of(&x, arm))
}

/// Returns a row of dyadic rationals times the power of two that makes it whole.
fn whole_row(row: &[BigRational]) -> Vec<BigInt> {
    let denominator = row.iter().map(BigRational::denom).max();
    let Some(common) = denominator else {
        return Vec::new();
    };
    row.iter()
        .map(|x| x.numer() * (common / x.denom()))
        .collect()
}
