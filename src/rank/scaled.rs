//! J as floating-point numbers, as it stands or scaled so that the unit of length and the length of axes do not matter.

use super::method::{Answer, Certainty, Quantity};
use crate::closure::matrix::Closure;
use crate::geom::scalars::Reals;
use faer::traits::ComplexField;
use faer::{Mat, MatRef};

/// Lever arms shorter than this, in the file's unit, are rounding errors.
pub(crate) const POINT: f64 = 1e-12;

/// J as it stands: 6k × f, lengths in the file's unit, about the global origin.
#[must_use]
pub fn as_it_stands(closure: &Closure<f64>) -> Mat<f64> {
    let columns = closure.dense(&Reals);
    Mat::from_fn(closure.rows(), columns.len(), |r, c| columns[c][r])
}

/// J with unit turns, lengths divided by the longest lever arm, and columns of unit length.
#[must_use]
pub fn scaled(closure: &Closure<f64>) -> Mat<f64> {
    let mut columns = closure.dense(&Reals);
    let (dim, turns) = (closure.dim, closure.dim / 2);
    let is_velocity = |row: usize| row % dim >= turns;
    // Unit turns first, so that the velocity entries are lever arms, whatever the length of the axes in the file.
    let normalise = |column: &mut Vec<f64>| {
        let turn = column
            .iter()
            .enumerate()
            .filter(|(r, _)| !is_velocity(*r))
            .map(|(_, x)| x * x)
            .sum::<f64>()
            .sqrt();
        if turn > 0.0 {
            column.iter_mut().for_each(|x| *x /= turn);
        }
        turn > 0.0
    };
    let turning: Vec<bool> = columns.iter_mut().map(normalise).collect();
    let arm = columns
        .iter()
        .zip(&turning)
        .filter(|(_, t)| **t)
        .flat_map(|(c, _)| {
            c.iter()
                .enumerate()
                .filter(|(r, _)| is_velocity(*r))
                .map(|(_, x)| x.abs())
        })
        .fold(0.0, f64::max);
    // Lever arms of rounding errors are none.
    let arm = if arm > POINT { arm } else { 1.0 };
    for column in &mut columns {
        column
            .iter_mut()
            .enumerate()
            .filter(|(r, _)| is_velocity(*r))
            .for_each(|(_, x)| *x /= arm);
        let length = column.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 {
            column.iter_mut().for_each(|x| *x /= length);
        }
    }
    Mat::from_fn(closure.rows(), columns.len(), |r, c| columns[c][r])
}

/// A numeric rank with the gap it rests on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumericRank {
    /// Number of values above the tolerance.
    pub rank: usize,
    /// The smallest kept value over the largest; 1 where none is kept.
    pub kept: f64,
    /// The largest dropped value over the largest; 0 where none is dropped.
    pub dropped: f64,
}

/// The rank that values (of any order and sign) show at a relative tolerance.
#[must_use]
pub fn rank_of_values(mut values: Vec<f64>, tolerance: f64) -> NumericRank {
    values.iter_mut().for_each(|v| *v = v.abs());
    values.sort_by(|a, b| b.total_cmp(a));
    let largest = values.first().copied().unwrap_or(0.0);
    let rank = if largest > 0.0 {
        values.iter().filter(|&&v| v > tolerance * largest).count()
    } else {
        0
    };
    let relative = |i: usize| values.get(i).map(|v| v / largest);
    NumericRank {
        rank,
        kept: rank.checked_sub(1).and_then(relative).unwrap_or(1.0),
        dropped: relative(rank).filter(|_| largest > 0.0).unwrap_or(0.0),
    }
}

/// A floating-point format to eliminate in.
pub trait Precision: ComplexField + Copy + Sync + std::fmt::Debug {
    /// Its name.
    const NAME: &'static str;
    /// The relative tolerance that suits it.
    const TOLERANCE: f64;
    /// The nearest number.
    fn nearest(x: f64) -> Self;
    /// As f64.
    fn wide(self) -> f64;
}

impl Precision for f32 {
    const NAME: &'static str = "f32";
    const TOLERANCE: f64 = 1e-4;
    #[allow(
        clippy::cast_possible_truncation,
        reason = "single precision is the point"
    )]
    fn nearest(x: f64) -> f32 {
        x as f32
    }
    fn wide(self) -> f64 {
        f64::from(self)
    }
}

impl Precision for f64 {
    const NAME: &'static str = "f64";
    const TOLERANCE: f64 = 1e-9;
    fn nearest(x: f64) -> f64 {
        x
    }
    fn wide(self) -> f64 {
        self
    }
}

/// A matrix in a format.
#[must_use]
pub fn in_format<T: Precision>(matrix: &Mat<f64>) -> Mat<T> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |r, c| {
        T::nearest(matrix[(r, c)])
    })
}

/// Absolute values on the diagonal of a triangular factor.
pub(super) fn diagonal<T: Precision>(factor: MatRef<'_, T>) -> Vec<f64> {
    (0..factor.nrows().min(factor.ncols()))
        .map(|i| factor[(i, i)].wide().abs())
        .collect()
}

/// The answer that a numeric rank gives.
pub(super) fn answer(closure: &Closure<f64>, rank: NumericRank, tolerance: f64) -> Answer {
    let int = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
    Answer {
        mobility: int(closure.columns.len()) - int(rank.rank),
        quantity: Quantity::Instantaneous,
        certainty: Certainty::Numeric {
            tolerance,
            kept: rank.kept,
            dropped: rank.dropped,
        },
    }
}
