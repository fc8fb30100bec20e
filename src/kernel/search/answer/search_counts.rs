//! The counts of a search: determinate variants, admissible ones, and those that keep the motion throughout.

use crate::search::answer::counts::{Counts, count_by_kind, count_sums};
use crate::search::build::{Diagrams, build_diagrams};
use crate::search::diagram::{Diagram, Stop};
use crate::search::question::Question;
use crate::search::question::conditions::{Conditions, SearchError, Symmetry};

/// The counts of a search.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SearchCounts {
    /// Variants without more redundant constraints than are allowed.
    pub determinate: Counts,
    /// Those of them that do all that is asked in the drawn pose.
    pub admissible: Counts,
    /// Those of them that do it throughout the motion of the mechanism as built; `None` where no motion is followed.
    pub lasting: Option<Counts>,
}

impl SearchCounts {
    /// Returns the counts of the variants of some diagrams.
    #[must_use]
    pub fn of_diagrams(question: &Question, diagrams: &Diagrams) -> SearchCounts {
        SearchCounts::count_each(diagrams, &|diagram, filter| {
            count_by_kind(question, diagram, filter)
        })
    }

    /// Returns the same without those by W and changes both, which take by far the longest where there are hundreds of joints.
    #[must_use]
    pub fn sums_of(question: &Question, diagrams: &Diagrams) -> SearchCounts {
        SearchCounts::count_each(diagrams, &|diagram, filter| {
            count_sums(question, diagram, filter)
        })
    }

    fn count_each(
        diagrams: &Diagrams,
        of: &(dyn Fn(&Diagram, bool) -> Counts + Sync),
    ) -> SearchCounts {
        let ((determinate, admissible), lasting) = rayon::join(
            || {
                rayon::join(
                    || of(&diagrams.determinate, false),
                    || of(&diagrams.admissible, true),
                )
            },
            || diagrams.lasting.as_ref().ok().map(|d| of(d, true)),
        );
        SearchCounts {
            determinate,
            admissible,
            lasting,
        }
    }

    /// Returns the counts of orbits of a symmetry, from all variants and the symmetric ones, by Burnside's lemma.
    pub(in crate::search) fn orbit_counts(
        self,
        symmetric: &SearchCounts,
        order: usize,
    ) -> SearchCounts {
        let lasting = self.lasting.zip(symmetric.lasting.as_ref());
        SearchCounts {
            determinate: self.determinate.orbit_counts(&symmetric.determinate, order),
            admissible: self.admissible.orbit_counts(&symmetric.admissible, order),
            lasting: lasting.map(|(all, kept)| all.orbit_counts(kept, order)),
        }
    }
}

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
