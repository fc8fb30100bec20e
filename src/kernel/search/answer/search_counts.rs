//! The counts of a search: determinate variants, admissible ones, and those that keep the motion throughout.

use crate::search::answer::counts::{Counts, count_orbits};
use crate::search::diagram::{Control, Diagram, ShouldCancel, Stop};
use crate::search::question::Question;
use crate::search::question::conditions::{Conditions, SearchError, Symmetry};
use crate::search::solve::{Diagrams, build_diagrams};
use num_bigint::BigUint;

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
        SearchCounts::by_kind(question, diagrams, true)
    }

    /// Returns the same, without those by W and changes together unless `both` is true: these take by far the longest where there are
    /// hundreds of joints.
    #[must_use]
    pub fn by_kind(question: &Question, diagrams: &Diagrams, both: bool) -> SearchCounts {
        let of = |diagram: &Diagram, filter| question.count_by_kind(diagram, filter, both);
        let lasting = || diagrams.lasting.as_ref().ok().map(|d| of(d, true));
        let (determinate, (admissible, lasting)) = rayon::join(
            || of(&diagrams.determinate, false),
            || rayon::join(|| of(&diagrams.admissible, true), lasting),
        );
        SearchCounts {
            determinate,
            admissible,
            lasting,
        }
    }
}

/// Returns the counts of orbits by Burnside's lemma, from those of all variants and a search for the symmetric ones. Also returns why that
/// search ended.
///
/// # Errors
/// Returns an error in the same cases as [`Question::new`].
pub fn orbit_counts(
    question: &Question,
    mut all: SearchCounts,
    cancelled: ShouldCancel<'_>,
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
    let diagrams = build_diagrams(&symmetric, Control::cancelled_by(cancelled));
    let order = question.mechanism.search.symmetry_order();
    let kept = SearchCounts::of_diagrams(&symmetric, &diagrams);
    let orbits = |all: &mut Counts, kept: &Counts| {
        let of = |n: &BigUint, kept: &BigUint| count_orbits(n, kept, order);
        if all.only_total {
            all.total = of(&all.total, &kept.total);
        } else {
            all.combine_with(kept, &of);
        }
    };
    orbits(&mut all.determinate, &kept.determinate);
    orbits(&mut all.admissible, &kept.admissible);
    all.lasting = all.lasting.zip(kept.lasting).map(|(mut all, kept)| {
        orbits(&mut all, &kept);
        all
    });
    let stops = [diagrams.determinate.stop, diagrams.admissible.stop];
    Ok((all, stops))
}
