//! The twelve equilibrium equations of the four-link group with a closed contour, by LU in double precision.

use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::kinetostatics::Worth;
use crate::statics::pose::{cross, length, minus};
use crate::statics::{condition_number, greatest_abs};
use ozols_dense::Matrix;

/// The two links of each of D, F, K, M, L: the first bears the unknown, the second (if in the group) its opposite.
const ENDS: [(usize, Option<usize>); 5] = [
    (0, None),
    (1, Some(0)),
    (2, Some(0)),
    (1, Some(3)),
    (2, Some(3)),
];

/// Returns the equations with moments about these origins of the links: rows of 12 coefficients and the right side. The
/// unknowns are the components at D, F, K, M, L, then the guide's reaction and its moment about D.
fn equilibrium_rows(g: &GroupPose, origins: [[f64; 2]; 4]) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; 13]; 12];
    for (j, (point, (first, second))) in [g.d, g.f, g.k, g.m, g.l].into_iter().zip(ENDS).enumerate()
    {
        for (link, sign) in [(Some(first), 1.0), (second, -1.0)] {
            let Some(link) = link else { continue };
            let [x, y] = minus(point, origins[link]);
            rows[3 * link][2 * j] = sign;
            rows[3 * link + 1][2 * j + 1] = sign;
            rows[3 * link + 2][2 * j] = -sign * y;
            rows[3 * link + 2][2 * j + 1] = sign * x;
        }
    }
    // The guide: a force at D along the normal, and a couple.
    let normal = g.guide_normal();
    rows[9][10] = normal[0];
    rows[10][10] = normal[1];
    rows[11][10] = cross(minus(g.d, origins[3]), normal);
    rows[11][11] = 1.0;
    for load in &g.loads {
        let arm = minus(load.point, origins[load.body]);
        let row = 3 * load.body;
        rows[row][12] -= load.force[0];
        rows[row + 1][12] -= load.force[1];
        rows[row + 2][12] = rows[row + 2][12] - cross(arm, load.force) - load.moment;
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
    let mut rows = equilibrium_rows(g, [g.d, g.m, g.l, g.m]);
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
