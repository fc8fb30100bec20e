//! Catalogues: every structure of a range of chains laid out, searched and scored, in a database for queries. This file has the searches
//! that a catalogue makes of its mechanisms.

pub mod build;
#[cfg(feature = "store")]
pub mod find;
pub mod general;
#[cfg(feature = "store")]
mod insert;
pub mod row;
pub mod spec;
#[cfg(feature = "store")]
pub mod store;

use crate::catalog::spec::{Spec, SpecError};
use crate::file::read::build_mechanism;
use crate::file::schema::MechanismFile;
use crate::geom::exact::ExactError;
use crate::model::mechanism::Mechanism;
use crate::redundancy::AnalysisError;
use crate::redundancy::analysis::exact_field;
use crate::score::request::{Check, List, Request};
use crate::score::run::RunError;
use crate::search::Search;
use itertools::Itertools;
use std::sync::Arc;
use thiserror::Error;

/// Why there is no row, for a reason that is not a property of the structure.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RowError {
    /// The specification is wrong.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A coordinate has no value.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The mechanism cannot be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The mechanism cannot be searched.
    #[error(transparent)]
    Search(#[from] RunError),
    /// The program itself wrote a wrong file for the layout.
    #[error("{structure}: its own file is refused: {why}")]
    File {
        /// The structure.
        structure: String,
        /// The reason.
        why: String,
    },
}

/// Returns the search that a catalogue makes of each mechanism. Variants of W = 1 move like the mechanism, so no further condition on their
/// outputs is needed.
///
/// # Examples
/// ```
/// use ozols::catalog::{search_request, spec::Spec};
/// let request = search_request(&Spec::default());
/// assert_eq!(request.max_mobility, Some(1));
/// ```
#[must_use]
pub fn search_request(spec: &Spec) -> Request {
    Request {
        max_mobility: Some(1),
        allow_output_change: true,
        list: List::Top(spec.ideas.max(1)),
        check: Check::Prime,
        nodes: spec.nodes,
        ..Request::default()
    }
}

/// Builds the mechanism of a file that the program made of a structure with this name.
pub(crate) fn built_mechanism(name: &str, file: &MechanismFile) -> Result<Mechanism, RowError> {
    build_mechanism(file).map_err(|found| RowError::File {
        structure: name.to_owned(),
        why: found.iter().map(|(_, kind)| kind.to_string()).join("; "),
    })
}

/// Prepares the search of a mechanism over the prime field with this number.
pub(crate) fn prepare_search(
    mechanism: Mechanism,
    spec: &Spec,
    prime: usize,
) -> Result<Search, RowError> {
    let request = search_request(spec);
    let prepared = request.prepare(mechanism, &mut |_| {});
    let prepared = prepared.map_err(RunError::from)?;
    let (conditions, _) = request
        .search_conditions(&prepared, &mut |_| {})
        .map_err(RunError::from)?;
    let mechanism = Arc::new(prepared.mechanism);
    let field = exact_field(&mechanism, prime)?;
    Ok(Search::new(field, mechanism, conditions).map_err(RunError::from)?)
}
