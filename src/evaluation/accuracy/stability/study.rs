//! What every study is given, and what it gives.

use crate::accuracy::timing::Clock;
use crate::chart::{Bands, Chart};

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
    pub(super) fn of_bands(name: impl Into<String>, bands: &Bands) -> Picture {
        Picture {
            name: name.into(),
            title: bands.title.clone(),
            svg: bands.svg(),
        }
    }

    pub(super) fn of_chart(name: impl Into<String>, chart: &Chart) -> Picture {
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
