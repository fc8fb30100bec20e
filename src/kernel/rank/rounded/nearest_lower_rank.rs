//! The nearest geometry whose closure matrix has a smaller rank, if rounding alone may have raised it.
//!
//! Let U2 and V2 be the singular vectors of J beyond the required rank. F = U2ᵀ J V2 vanishes to second order if and
//! only if J has that rank (Golub & Van Loan, "Matrix Computations", 2013, 8.6). Newton's method makes it vanish with
//! the smallest change of coordinates, measured in units of their last digit.

use crate::closure::Closure;
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::Reals;
use crate::geom::expr::Expr;
use crate::model::mechanism::{Mechanism, StateId};
use crate::model::rounded::Uncertainties;
use crate::rank::numeric::scaling::{Scaling, scaled_matrix};
use crate::rank::rounded::{Coordinate, frame_with, rounded_coordinates};
use ozols_dense::{Matrix, difference, dot, largest_entry, svd, thin_svd};

/// Maximum number of Newton steps.
const STEPS: usize = 12;
/// The largest move of a coordinate that rounding explains, in units of its last digit: half a unit, plus the spread of
/// the least squares.
const MOST: f64 = 1.05;
/// Threshold that one in a thousand roundings exceeds, in standard deviations, on one side.
const RARE: f64 = 3.09;
/// The same threshold on both sides.
const RARE_EITHER_WAY: f64 = 3.29;
/// Values of F below this count as zero.
const ZERO: f64 = 1e-12;
/// Changes that affect F by less than this share of the largest effect are ignored, because they follow from the
/// others.
const FELT: f64 = 1e-3;
/// Maximum size of the problem: equations · coordinates · the smaller of the two.
const LARGEST: usize = 200_000_000;
/// Step of a finite difference, relative to the size of the moved quantity. Twists are at most quadratic in
/// coordinates.
const DIFFERENCE: f64 = 1e-5;

/// The geometry found.
#[derive(Debug, Clone)]
pub struct Nearest {
    /// The mechanism, with its coordinates as doubles.
    pub mechanism: Mechanism,
    /// The largest change of a coordinate, in units of its last digit.
    pub moved: f64,
    /// Number of independent conditions that the coordinates satisfy at that rank.
    pub conditions: usize,
}

/// Returns the mechanism with each coordinate moved by that many units.
fn move_coordinates(m: &Mechanism, of: &[Coordinate], by: &[f64]) -> Option<Mechanism> {
    let mut out = m.clone();
    for (c, x) in of.iter().zip(by) {
        let frame = &mut out.parts_mut().joints[c.joint].frame;
        frame.vectors_mut()[c.vector][c.component] =
            Expr::from_f64(c.written + x * 2.0 * c.half).ok()?;
    }
    Some(out)
}

/// Returns the nearest geometry in which J of a state has a rank, with no coordinate moved by more than about a unit of
/// its last digit. Returns `None` if there is none, or if the mechanism is too large for the search.
///
/// # Guarantee
/// Numeric: J of the returned mechanism has the required rank within double precision. That this geometry is the
/// intended one is likely, not proven.
///
/// # Complexity
/// At most 12 decompositions of a matrix of (6k - rank)(f - rank) rows and 9p columns.
#[must_use]
pub fn nearest_of_rank(
    m: &Mechanism,
    state: StateId,
    rank: usize,
    half: &Uncertainties,
) -> Option<Nearest> {
    let of = rounded_coordinates(m, m.joints_in(state), half);
    let mut closure = Closure::new(&Reals, m, state).ok()?;
    let contours = closure.contours.clone();
    let equations = (closure.rows() - rank) * (closure.columns.len() - rank);
    if of.is_empty() || equations * of.len() * equations.min(of.len()) > LARGEST {
        return None;
    }
    let (mut by, mut found, mut conditions) = (vec![0.0_f64; of.len()], m.clone(), 0);
    for _ in 0..STEPS {
        let matrix = scaled_matrix(&closure);
        let singular = svd(&matrix)?;
        let beyond = singular.values.get(rank).copied().unwrap_or(0.0);
        if beyond <= ZERO * singular.values[0] {
            let (most, square) = (largest_entry(&by), dot(&by, &by));
            let likely = most <= MOST && square <= largest_square(conditions);
            return likely.then_some(Nearest {
                mechanism: found,
                moved: most,
                conditions,
            });
        }
        let (left, right) = (singular.left_null_space(rank), singular.null_space(rank));
        let residue = left.transpose_times(&matrix.times(&right));
        let change = changes_of_residue(&found, &closure, &of, &by, &left, &right)?;
        let (step, felt) = least_step(&change, &residue)?;
        conditions = conditions.max(felt);
        by = difference(&by, &step);
        // The solution is already too far off: no step leads back within a unit.
        if by.iter().any(|x| !x.is_finite() || x.abs() > 10.0 * MOST) {
            return None;
        }
        found = move_coordinates(m, &of, &by)?;
        closure = Closure::with_contours(&Reals, &found, state, contours.clone()).ok()?;
    }
    None
}

/// Returns the change of F with each coordinate, per unit of its last digit: one column per coordinate. Couplings are
/// unaffected, because they are linear in the joints' own rates.
fn changes_of_residue(
    m: &Mechanism,
    closure: &Closure<f64>,
    of: &[Coordinate],
    by: &[f64],
    left: &Matrix,
    right: &Matrix,
) -> Option<Matrix> {
    let scaling = Scaling::of_closure(closure);
    let space = MotionSpace::new(&Reals, &m.mode).ok()?;
    let (rows, columns) = (left.ncols(), right.ncols());
    let mut out = Matrix::zeros(rows * columns, of.len());
    for (p, c) in of.iter().enumerate() {
        let freedoms = m.joints[c.joint].joint_type.freedoms();
        let unit = 2.0 * c.half;
        let step = DIFFERENCE * c.scale / unit;
        let shifted = |d: f64| frame_with(m, c, c.written + (by[p] + d) * unit);
        let (before, after) = (shifted(-step), shifted(step));
        for (n, column) in closure.columns.iter().enumerate() {
            if column.joint != c.joint {
                continue;
            }
            let twist = |f: &FrameValues<f64>| {
                let mut all = f.twists_in_space(&Reals, &space, freedoms).into_iter();
                let (_, t) = all.find(|(f, _)| *f == column.freedom)?;
                Some(scaling.scale_column(n, &t))
            };
            let (a, b) = (twist(&before)?, twist(&after)?);
            let rate: Vec<f64> = (a.iter().zip(&b))
                .map(|(a, b)| (b - a) / (2.0 * step))
                .collect();
            for (k, contour) in closure.contours.iter().enumerate() {
                let Some(forward) = contour.direction_of(c.joint) else {
                    continue;
                };
                let sign = if forward { 1.0 } else { -1.0 };
                for i in 0..rows {
                    let along: f64 = (rate.iter().enumerate())
                        .map(|(r, x)| x * left[(closure.dim * k + r, i)])
                        .sum();
                    for j in 0..columns {
                        out[(i * columns + j, p)] += sign * along * right[(n, j)];
                    }
                }
            }
        }
    }
    Some(out)
}

/// Returns the smallest x with `change · x` = `residue` in the directions that matter, and the number of these
/// directions.
fn least_step(change: &Matrix, residue: &Matrix) -> Option<(Vec<f64>, usize)> {
    let columns = residue.ncols();
    let right = Matrix::from_fn(change.nrows(), 1, |r, _| {
        residue[(r / columns, r % columns)]
    });
    let factors = thin_svd(change)?;
    let felt = factors.rank(FELT);
    Some((factors.least_norm(felt, &right).col(0).to_vec(), felt))
}

/// Returns the square of the longest move that rounding explains, in units of the last digit.
///
/// Rounding errors are uniform and independent, of variance 1/12. The smallest move back is their projection to as many
/// dimensions as there are conditions, so twelve times its square nearly follows the chi-square law. For one condition
/// that is the square of a normal number. For more, its quantile is that of Wilson & Hilferty ("The distribution of
/// chi-square", 1931), too high by less than 3 %.
fn largest_square(conditions: usize) -> f64 {
    if conditions <= 1 {
        return RARE_EITHER_WAY.powi(2) / 12.0;
    }
    let n = conditions as f64;
    let part = 2.0 / (9.0 * n);
    n * (1.0 - part + RARE * part.sqrt()).powi(3) / 12.0
}

#[cfg(test)]
mod tests {
    use super::largest_square;

    #[test]
    fn moves_are_as_long_as_chi_square_allows() {
        // Quantiles of 0.999 from the tables: 10.83, 16.27, 29.59.
        for (n, quantile) in [(1, 10.83), (3, 16.27), (10, 29.59)] {
            let found = 12.0 * largest_square(n);
            assert!((found / quantile - 1.0).abs() < 0.03, "{n}: {found}");
        }
    }
}
