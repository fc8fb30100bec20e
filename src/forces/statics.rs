//! Statics of mechanisms: Assur groups and their kinetostatics, and joint reactions of any mechanism, planar or spatial.
//! Knows geometry and motion, and nothing of files, searches or reports.
//!
//! [`solve::solve`] takes a mechanism to its reactions: in its plane ([`cycle`]) where that determines them, otherwise in
//! space ([`reactions`]).

pub mod assur;
pub mod assur_class;
pub(crate) mod cone_programme;
pub mod contour_group;
pub mod cycle;
pub mod inertia;
pub mod kinetostatics;
pub mod planar;
pub mod planar_motion;
pub mod pose;
pub mod reactions;
pub mod solve;
pub mod transmission;

use crate::statics::planar::{BodyId, PairId, PairKind};
use crate::statics::pose::{Linkage, cross, minus};
use ozols_dense::{Matrix, determinant, singular_values, solve};
use serde::Serialize;

/// What a pair passes on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Reaction {
    /// The pair.
    #[serde(skip)]
    pub pair: PairId,
    /// Where the pair is now: its point on the second body `[m]`.
    pub point: [f64; 2],
    /// Force of the first body on the second `[N]`.
    pub force: [f64; 2],
    /// Moment of the first body on the second, about `point` `[N·m]`.
    pub moment: f64,
    /// Torque `[N·m]` or force `[N]` of a drive on the second body; part of `force` and `moment`.
    pub effort: Option<f64>,
}

impl Reaction {
    /// Returns the reaction with 0 for what is at most `least` `[N]`, moments divided by the mechanism's size.
    pub(crate) fn without(mut self, least: f64, linkage: &Linkage) -> Reaction {
        let turns = linkage.mechanism.pairs[self.pair].kind == PairKind::Turning;
        let [of_force, of_moment] = [least, least * linkage.size].map(|x| move |y| without(x, y));
        (self.force, self.moment) = (self.force.map(of_force), of_moment(self.moment));
        self.effort = if turns {
            self.effort.map(of_moment)
        } else {
            self.effort.map(of_force)
        };
        self
    }

    /// Force and moment about a point on one of the two bodies; zero on any other.
    #[must_use]
    pub fn on(&self, linkage: &Linkage, body: BodyId, about: [f64; 2]) -> [f64; 3] {
        let sign = match linkage.mechanism.pairs[self.pair].bodies {
            [_, b] if b == body => 1.0,
            [a, _] if a == body => -1.0,
            _ => 0.0,
        };
        let moment = self.moment + cross(minus(self.point, about), self.force);
        [self.force[0], self.force[1], moment].map(|x| sign * x)
    }
}

/// Returns the size up to which figures of a solution are rounding: what its equations leave over, and no less than the
/// rounding of a sum of `terms` numbers as great as the greatest of them.
pub(crate) fn rounding(left_over: f64, greatest: f64, terms: usize) -> f64 {
    left_over.max(f64::EPSILON * terms as f64 * greatest)
}

/// Returns a figure, or 0 if it is rounding. If the rounding is not finite, no figure is.
pub(crate) fn without(rounding: f64, figure: f64) -> f64 {
    if figure.abs() <= rounding && rounding.is_finite() {
        0.0
    } else {
        figure
    }
}

/// Returns the greatest size among figures.
pub(crate) fn greatest<'x>(figures: impl IntoIterator<Item = &'x f64>) -> f64 {
    let sizes = figures.into_iter().map(|x| x.abs());
    sizes.fold(0.0, f64::max)
}

/// Returns what equations leave over as a share of the greatest load, or as it is without loads.
pub(crate) fn over_load(left_over: f64, load: f64) -> f64 {
    left_over / if load > 0.0 { load } else { 1.0 }
}

/// A square system, by rows.
#[derive(Debug, Clone)]
pub(crate) struct DenseSystem {
    matrix: Matrix,
}

impl DenseSystem {
    /// Takes the rows of a square matrix.
    pub(crate) fn new(rows: &[Vec<f64>]) -> DenseSystem {
        DenseSystem {
            matrix: Matrix::from_fn(rows.len(), rows.len(), |r, c| rows[r][c]),
        }
    }

    /// The solution by LU with partial pivoting; `None` where it is not finite.
    pub(crate) fn solve(&self, right: &[f64]) -> Option<Vec<f64>> {
        let x = solve(&self.matrix, right);
        x.iter().all(|v| v.is_finite()).then_some(x)
    }

    /// Greatest absolute value of matrix·x - right.
    pub(crate) fn residual(&self, x: &[f64], right: &[f64]) -> f64 {
        let row = |r: usize| -> f64 {
            let sum: f64 = x
                .iter()
                .enumerate()
                .map(|(c, v)| self.matrix[(r, c)] * v)
                .sum();
            (sum - right[r]).abs()
        };
        (0..right.len()).map(row).fold(0.0, f64::max)
    }

    /// Whether the determinant is positive.
    pub(crate) fn is_positive(&self) -> bool {
        determinant(&self.matrix) > 0.0
    }

    /// Ratio of the greatest and smallest singular values; infinite for singular matrices.
    pub(crate) fn condition(&self) -> f64 {
        if self.matrix.nrows() == 0 {
            return 1.0;
        }
        let Some(values) = singular_values(&self.matrix) else {
            return f64::INFINITY;
        };
        let greatest = values.iter().copied().fold(0.0, f64::max);
        let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
        if smallest > 0.0 {
            greatest / smallest
        } else {
            f64::INFINITY
        }
    }
}
