//! Sweeps: the parameters of a mechanism file taken over a grid or at random, each sample analysed, searched and loaded as a
//! mechanism of its own.
//!
//! What is found holds at the samples. Nothing is said of what lies between them.

pub mod forces;
pub mod known_or_why;
pub mod redesigns;
pub mod row;
pub mod space;
pub(crate) mod stroke;
pub mod summary;
pub mod table;

use crate::file::problem::ImportError;
use crate::file::text::{mechanism_at, parameters_of};
use crate::model::loads::Stroke;
use crate::score::request::Request;
use crate::sweep::space::{Sampling, Space, SpaceError};
use thiserror::Error;

/// A sweep that is asked for.
#[derive(Debug, Clone)]
pub struct Spec {
    /// Name of the file, for messages; what ends in `.json` is JSON.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Where it is looked at.
    pub sampling: Sampling,
    /// What is found out there.
    pub asked: SweepRequest,
}

/// What is found out at each sample, beside mobility and redundant constraints of each state.
#[derive(Debug, Clone)]
pub struct SweepRequest {
    /// The search for redesigns, where there is to be one.
    pub search: Option<Request>,
    /// How many of the best redesigns are listed, beside all that share the first place.
    pub top: usize,
    /// A stroke of the first drive, as it was written and read, where the rank is to be followed.
    pub stroke: Option<(String, Stroke)>,
    /// Whether every rank method is asked, and its answer judged.
    pub methods: bool,
    /// Whether every digit is taken at its word.
    pub as_written: bool,
}

/// A sweep that can be made.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// What is asked.
    pub spec: Spec,
    /// Name of the mechanism.
    pub mechanism: String,
    /// Its samples.
    pub space: Space,
}

/// Why there is no sweep.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The file says what it should not, its parameters at their defaults.
    #[error(transparent)]
    File(#[from] ImportError),
    /// The samples cannot be had.
    #[error("{file}: {why}")]
    Space {
        /// The file.
        file: String,
        /// Why not.
        why: SpaceError,
    },
}

impl Sweep {
    /// Reads the file, and finds its samples.
    ///
    /// # Errors
    /// Where the file cannot be used with its parameters at their defaults, none of them varies, or there are too many samples.
    pub fn new(spec: Spec) -> Result<Sweep, SweepError> {
        let parameters = parameters_of(&spec.file, &spec.text)?;
        let mechanism = mechanism_at(&spec.file, &spec.text, &Default::default())?;
        let space = Space::new(&parameters, spec.sampling).map_err(|why| SweepError::Space {
            file: spec.file.clone(),
            why,
        })?;
        Ok(Sweep {
            mechanism: mechanism.name,
            space,
            spec,
        })
    }
}
