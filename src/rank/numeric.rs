//! Rank from singular values in double precision.

use crate::closure::matrix::Closure;
use crate::geom::scalars::Reals;
use faer::Mat;
use thiserror::Error;

/// Singular values below this fraction of the largest count as zero unless the caller says otherwise.
pub const DEFAULT_TOLERANCE: f64 = 1e-9;

/// Why no singular values could be had.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum NumericError {
    /// The decomposition did not converge, or an entry is not finite.
    #[error(
        "the singular values did not converge; check the coordinates for extreme values or use the exact method"
    )]
    NoConvergence,
}

/// A rank with the gap in the singular values that it rests on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumericRank {
    /// Number of singular values above the tolerance.
    pub rank: usize,
    /// The smallest kept singular value over the largest; 1 where none is kept.
    pub kept: f64,
    /// The largest dropped singular value over the largest; 0 where none is dropped.
    pub dropped: f64,
}

/// Rank of J with the default tolerance, see [`rank_with_tolerance`].
///
/// # Errors
/// Where the decomposition fails.
pub fn rank(closure: &Closure<f64>) -> Result<NumericRank, NumericError> {
    rank_with_tolerance(closure, DEFAULT_TOLERANCE)
}

/// Rank of J by singular values. Lengths are divided by the largest velocity entry first and columns scaled to unit
/// length, so that the answer does not depend on the unit of length.
///
/// # Errors
/// Where the decomposition fails.
///
/// # Complexity
/// O(6k · f · min(6k, f)).
pub fn rank_with_tolerance(
    closure: &Closure<f64>,
    tolerance: f64,
) -> Result<NumericRank, NumericError> {
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
    for column in &mut columns {
        if arm > 0.0 {
            column
                .iter_mut()
                .enumerate()
                .filter(|(r, _)| is_velocity(*r))
                .for_each(|(_, x)| *x /= arm);
        }
        let length = column.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 {
            column.iter_mut().for_each(|x| *x /= length);
        }
    }
    if columns.is_empty() || closure.rows() == 0 {
        return Ok(NumericRank {
            rank: 0,
            kept: 1.0,
            dropped: 0.0,
        });
    }
    let matrix = Mat::from_fn(closure.rows(), columns.len(), |r, c| columns[c][r]);
    let mut values = matrix
        .singular_values()
        .map_err(|_| NumericError::NoConvergence)?;
    if values.iter().any(|v| !v.is_finite()) {
        return Err(NumericError::NoConvergence);
    }
    values.sort_by(|a, b| b.total_cmp(a));
    let largest = values[0];
    let rank = values.iter().filter(|&&v| v > tolerance * largest).count();
    let relative = |i: usize| values.get(i).map(|v| v / largest);
    Ok(NumericRank {
        rank,
        kept: rank.checked_sub(1).and_then(relative).unwrap_or(1.0),
        dropped: relative(rank).unwrap_or(0.0),
    })
}
