//! The twelve equilibrium equations of the four-link group with a closed contour, solved in rational arithmetic.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};
use ozols::statics::contour_group::pose::{GroupPose, GroupReactions};

/// The two links of each of D, F, K, M, L: the first bears the unknown, the second (if in the group) its opposite.
const ENDS: [(usize, Option<usize>); 5] = [
    (0, None),
    (1, Some(0)),
    (2, Some(0)),
    (1, Some(3)),
    (2, Some(3)),
];

/// Returns the equations with moments about the origin: rows of 12 coefficients and the right side. The unknowns are the
/// components at D, F, K, M, L, then the guide's reaction and its moment about D.
fn exact_rows(g: &GroupPose) -> Vec<Vec<BigRational>> {
    let number = |x: f64| BigRational::from_float(x).unwrap_or_else(BigRational::zero);
    let mut rows = vec![vec![BigRational::zero(); 13]; 12];
    let vector = |p: [f64; 2]| p.map(number);
    for (j, (point, (first, second))) in [g.d, g.f, g.k, g.m, g.l].into_iter().zip(ENDS).enumerate()
    {
        for (link, sign) in [(Some(first), 1.0), (second, -1.0)] {
            let Some(link) = link else { continue };
            let [x, y] = vector(point);
            rows[3 * link][2 * j] = number(sign);
            rows[3 * link + 1][2 * j + 1] = number(sign);
            rows[3 * link + 2][2 * j] = number(-sign) * y;
            rows[3 * link + 2][2 * j + 1] = number(sign) * x;
        }
    }
    // The guide: a force at D along the normal, and a couple.
    let [nx, ny] = vector(g.guide_normal());
    let [x, y] = vector(g.d);
    rows[9][10] = nx.clone();
    rows[10][10] = ny.clone();
    rows[11][10] = x * ny - y * nx;
    rows[11][11] = number(1.0);
    for load in &g.loads {
        let [fx, fy] = vector(load.force);
        let [x, y] = vector(load.point);
        let row = 3 * load.body;
        rows[row][12] -= &fx;
        rows[row + 1][12] -= &fy;
        rows[row + 2][12] -= x * fy - y * fx + number(load.moment);
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

/// Returns the reactions in rational arithmetic, with every number of the pose taken exactly, then rounded. Returns
/// `None` if the equations are singular or a number is not finite.
///
/// # Complexity
/// O(12³) operations on whole numbers that grow to about a thousand bits.
pub(crate) fn solve_exactly(g: &GroupPose) -> Option<GroupReactions> {
    let numbers = g
        .loads
        .iter()
        .flat_map(|l| [l.point[0], l.point[1], l.force[0], l.force[1], l.moment]);
    let points = [g.d, g.f, g.k, g.m, g.l, g.guide].into_iter().flatten();
    if !numbers.chain(points).all(f64::is_finite) {
        return None;
    }
    let rows = exact_rows(g);
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
