//! Counts of orbits: of each variant and its images, one.

use crate::search::answer::search_counts::SearchCounts;
use crate::search::build::build_diagrams;
use crate::search::diagram::Stop;
use crate::search::question::Question;
use crate::search::question::conditions::{Conditions, SearchError, Symmetry};

/// Computes the counts of orbits from those of all variants, by a search for the symmetric ones. Also returns why that search ended.
///
/// # Errors
/// Returns an error in the same cases as [`Question::new`].
pub fn orbit_counts(
    question: &Question,
    all: SearchCounts,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<(SearchCounts, [Stop; 2]), SearchError> {
    let conditions = Conditions {
        symmetry: Symmetry::SymmetricOnly,
        cheapest: 0,
        estimate: None,
        ..question.conditions.clone()
    };
    let symmetric = Question::new(
        question.exact.clone(),
        question.mechanism.clone(),
        conditions,
    )?;
    let diagrams = build_diagrams(&symmetric, cancelled, &mut |_| {});
    let order = question.mechanism.search.symmetry_order();
    let counts = all.orbit_counts(&SearchCounts::of_diagrams(&symmetric, &diagrams), order);
    let stops = [diagrams.determinate.stop, diagrams.admissible.stop];
    Ok((counts, stops))
}
