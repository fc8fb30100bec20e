//! Counts of orbits: of each variant and its images, one.

use crate::search::answer::counts::{Counts, counts};
use crate::search::build::build;
use crate::search::diagram::Stop;
use crate::search::question::Question;
use crate::search::question::conditions::{Conditions, SearchError, Symmetry};

/// Counts of orbits from counts of all variants, by a search for the symmetric ones, and why that search ended.
///
/// # Errors
/// As [`Question::new`].
pub fn orbit_counts(
    question: &Question,
    all: (Counts, Counts),
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<((Counts, Counts), [Stop; 2]), SearchError> {
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
    let diagrams = build(&symmetric, cancelled, &mut |_| {});
    let order = question.mechanism.search.order();
    let determinate = counts(&symmetric, &diagrams.determinate, false);
    let admissible = counts(&symmetric, &diagrams.admissible, true);
    let determinate = all.0.orbits(&determinate, order);
    let admissible = all.1.orbits(&admissible, order);
    let stops = [diagrams.determinate.stop, diagrams.admissible.stop];
    Ok(((determinate, admissible), stops))
}
