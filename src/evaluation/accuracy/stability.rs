//! Where numbers fail: geometry, closeness to special ones, shakiness, size, scale, noise, rounding and tolerance moved until
//! answers turn wrong.

pub mod change;
pub mod close;
mod digits;
mod distance;
mod noise;
mod offsets;
mod rounded;
pub mod said;
mod scale;
pub mod shaky;
mod size;
pub mod special;
mod study;
pub(crate) mod sweep;
mod tolerance;

use super::BuiltIn;
use super::survey::Case;
use crate::file::problem::ImportError;

pub use study::{Effort, Picture, Progress, Study};

/// Every study in turn.
///
/// # Errors
/// Where a built-in file is not valid.
pub fn all(
    built_in: BuiltIn<'_>,
    cases: &[Case],
    effort: Effort,
    progress: Progress<'_>,
) -> Result<Vec<Study>, ImportError> {
    let some: Vec<Case> = cases
        .iter()
        .step_by(if effort.quick { 4 } else { 1 })
        .cloned()
        .collect();
    Ok(vec![
        distance::study(built_in, effort, progress)?,
        close::study(effort, progress),
        shaky::study(effort, progress),
        size::study(effort, progress),
        scale::study(&some, effort, progress),
        noise::study(&some, effort, progress),
        rounded::study(&some, effort, progress),
        digits::study(&some, effort, progress),
        offsets::study(effort, progress),
        tolerance::study(&some, effort, progress),
    ])
}
