//! Where numbers fail: geometry, closeness to special ones, shakiness, size, scale, noise, rounding and tolerance moved until
//! answers turn wrong.

mod asked;
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
mod sketch;
pub mod special;
pub mod sweep;
mod tolerance;

use super::survey::Case;
use super::timing::Clock;
use crate::chart::{Bands, Chart};
use crate::file::problem::ImportError;

/// A picture of a study.
#[derive(Debug, Clone)]
pub struct Picture {
    /// The stem of its file.
    pub name: String,
    /// What is shown.
    pub title: String,
    /// The picture.
    pub svg: String,
}

/// A series of experiments with what it shows.
#[derive(Debug, Clone)]
pub struct Study {
    /// The stem of its files.
    pub name: &'static str,
    /// What was varied.
    pub title: String,
    /// What came of it, from the data.
    pub sentence: String,
    /// Its pictures.
    pub pictures: Vec<Picture>,
    /// Its data.
    pub csv: String,
}

impl Picture {
    fn of_bands(name: impl Into<String>, bands: &Bands) -> Picture {
        Picture {
            name: name.into(),
            title: bands.title.clone(),
            svg: bands.svg(),
        }
    }

    fn of_chart(name: impl Into<String>, chart: &Chart) -> Picture {
        Picture {
            name: name.into(),
            title: chart.title.clone(),
            svg: chart.svg(),
        }
    }
}

/// How much to do.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Coarse steps and part of the mechanisms.
    pub quick: bool,
    /// Seed of the noise.
    pub seed: u64,
    /// What times are taken by.
    pub clock: Clock,
}

/// Is told the study under way, the steps done and their number.
pub type Progress<'a> = &'a mut dyn FnMut(&str, usize, usize);

/// Every study in turn.
///
/// # Errors
/// Where a built-in file is not valid.
pub fn all(
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
        distance::study(effort, progress)?,
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
