//! The rank over a stroke, at a sample.

use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::NoAnswer;
use crate::rank::rounded::verdict::verdict;
use crate::rank::stroke::request::{AskedError, AskedStroke};
use crate::sweep::forces::rounded;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// What a stroke shows; positions in radians, or the file's unit of length where the drive slides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OverStroke {
    /// The poses reached, the first among them.
    pub poses: usize,
    /// Whether that are all of them.
    pub complete: bool,
    /// Where the rank changes, by singular values: between which positions, and σ at it beyond that before.
    pub changes: Vec<(f64, f64, i64)>,
    /// The smallest singular value kept over the largest, in the pose where that is least.
    pub least_conditioning: f64,
    /// That pose.
    pub at: f64,
}

/// Why there is no stroke.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum StrokeError {
    /// The mechanism cannot be followed.
    #[error(transparent)]
    Asked(#[from] AskedError),
    /// Its rank has no answer.
    #[error(transparent)]
    Rank(#[from] NoAnswer),
}

/// Follows the first drive of a state over a range, as it was written and read.
///
/// # Errors
/// Where it has none, or which mechanism is meant is not decided.
pub(super) fn over_stroke(
    m: &Mechanism,
    state: StateId,
    text: &str,
    range: Stroke,
) -> Result<OverStroke, StrokeError> {
    let verdict = verdict(m, state)?;
    let found = AskedStroke::new(m, state, text, range, None, &verdict, None)?.follow();
    let int = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    let worst = found
        .poses
        .iter()
        .min_by(|a, b| a.rank.kept.total_cmp(&b.rank.kept));
    Ok(OverStroke {
        poses: found.poses.len(),
        complete: found.stop.is_none(),
        changes: found
            .changes
            .iter()
            .map(|c| {
                let [before, at, _] = c.ranks;
                (
                    rounded(c.between[0]),
                    rounded(c.between[1]),
                    int(before) - int(at),
                )
            })
            .collect(),
        least_conditioning: worst.map_or(0.0, |p| rounded(p.rank.kept)),
        at: worst.map_or(0.0, |p| rounded(p.at)),
    })
}
