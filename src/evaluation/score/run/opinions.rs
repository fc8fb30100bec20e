//! What singular values say of a search.

use crate::score::outcome::ranking::RankedPool;
use crate::score::request::error::RunError;
use crate::score::request::{List, Request};
use crate::search::Search;
use crate::search::answer::counts::Counts;
use crate::search::answer::k_best::Assignment;
use crate::search::build::Diagrams;
use crate::search::check::second_opinion::{self, SecondOpinion};
use crate::search::check::singular_values::CHECKED;

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
