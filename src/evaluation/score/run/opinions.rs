//! What singular values, and other scenes that the digits do not rule out, say of a search.

use crate::redundancy::analysis::exact_field;
use crate::score::outcome::ranking::RankedPool;
use crate::score::request::error::RunError;
use crate::score::request::{List, Request};
use crate::search::Search;
use crate::search::answer::counts::Counts;
use crate::search::answer::k_best::Assignment;
use crate::search::build::Diagrams;
use crate::search::check::second_opinion::{self, SecondOpinion};
use crate::search::check::singular_values::CHECKED;
use crate::search::question::conditions::Conditions;
use num_bigint::BigUint;

/// Of so many ideas the first variants get a second opinion.
const IDEAS: usize = 100;

/// Returns the finding of singular values on the counts, the listed variants and a sample, if coordinates look rounded.
pub(super) fn opinion_on_diagrams(
    search: &Search,
    diagrams: &Diagrams,
    determinate: &Counts,
    ranking: Option<&RankedPool>,
    request: &Request,
) -> Result<Option<SecondOpinion>, RunError> {
    let Some(written) = &search.conditions.written else {
        return Ok(None);
    };
    let mut listed: Vec<Assignment> = match (ranking, request.list) {
        (Some(r), _) => r
            .list
            .iter()
            .map(|r| r.variant.clone())
            .take(CHECKED)
            .collect(),
        (_, List::Top(k)) => search.cheapest_variants(diagrams, k.min(CHECKED)).collect(),
        (_, List::All) => search.cheapest_variants(diagrams, CHECKED).collect(),
        (_, List::Sample(n)) => {
            let drawn = search.sample_variants(diagrams, request.seed);
            drawn.take(n.min(CHECKED)).collect()
        }
        (_, List::Nothing) => Vec::new(),
    };
    // People are given the first of each idea.
    if let (None, List::Top(k @ 1..=IDEAS)) = (ranking, request.list) {
        listed.extend(search.list_ideas(diagrams, k).into_iter().map(|i| i.first));
    }
    let most = second_opinion::sample_size(search);
    let drawn = search
        .sample_variants(diagrams, request.seed)
        .take(most)
        .collect();
    let said =
        second_opinion::second_opinion(search, written, listed, drawn, determinate, request.seed)?;
    Ok(Some(said))
}

/// Returns the least and the most (determinate, admissible) over the scenes that the digits do not rule out; `None` if all are the same,
/// also by mobility.
pub(super) fn other_scenes(
    search: &Search,
    determinate: &Counts,
    admissible: &Counts,
    should_cancel: &(dyn Fn() -> bool + Sync),
) -> Result<Option<[(BigUint, BigUint); 2]>, RunError> {
    let scenes = search.conditions.written.iter().flat_map(|w| &w.others);
    let own = (determinate.total.clone(), admissible.total.clone());
    let (mut range, mut differ) = ([own.clone(), own], false);
    for scene in scenes {
        let field = exact_field(scene, 0)?;
        let conditions = Conditions {
            estimate: None,
            throughout: false,
            ..search.conditions.clone()
        };
        let other = Search::new(field, scene.clone(), conditions)?;
        let built = other.build_diagrams(should_cancel, &mut |_| {});
        let found = (
            other.count_variants(&built.determinate, false),
            other.count_variants(&built.admissible, true),
        );
        differ |= found.0.by_mobility != determinate.by_mobility
            || found.1.by_mobility != admissible.by_mobility;
        let [least, most] = &mut range;
        for (total, least, most) in [
            (found.0.total, &mut least.0, &mut most.0),
            (found.1.total, &mut least.1, &mut most.1),
        ] {
            if total < *least {
                least.clone_from(&total);
            }
            if total > *most {
                *most = total;
            }
        }
    }
    Ok(differ.then_some(range))
}
