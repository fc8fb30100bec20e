//! The k-th variant of the list that a search gives.

use super::args::Question;
use super::{question, ranked};
use crate::model::joint_type::JointType;
use crate::model::mechanism::Mechanism;
use crate::redundancy::analysis::exact_field;
use crate::search::best::Variant;
use crate::search::request::Search;
use anyhow::{Context, ensure};
use std::ops::ControlFlow;

/// What `with` makes of variant `k` of the list that `ozols search` gives for the same question: the cheapest first, or in
/// the order of the ranking that the file or the question asks for. `state` is the one that --max-external is about.
pub(super) fn kth<T>(
    mechanism: &mut Mechanism,
    a: &Question,
    state: Option<&str>,
    k: usize,
    with: impl FnOnce(&Search<'_>, &Variant) -> T,
) -> anyhow::Result<T> {
    ensure!(k > 0, "variants are numbered from 1");
    question::ready(mechanism, a)?;
    let (request, _) = question::ask(mechanism, a, state)?;
    let search = Search::new(exact_field(mechanism, 0)?, mechanism, request)?;
    let diagrams = search.build(&|| false, &mut |_| {});
    let (mut last, mut seen) = (None, 0);
    match ranked::pool(&search, &diagrams, a, k)? {
        Some(pool) => {
            seen = pool.list.len();
            last = pool.list.into_iter().nth(k - 1).map(|r| r.variant);
        }
        None => search.cheapest(&diagrams, k, |v| {
            seen += 1;
            last = Some(v);
            ControlFlow::Continue(())
        }),
    }
    let variant = last.filter(|_| seen >= k).with_context(|| {
        format!(
            "{} has no variant {k}: the search gives {seen}",
            mechanism.name
        )
    })?;
    Ok(with(&search, &variant))
}

/// A variant as a mechanism of its own, named for its place in the list.
pub(super) fn mechanism(search: &Search<'_>, variant: &Variant, k: usize) -> Mechanism {
    let mut out = search.realize(&variant.choices);
    let changes = crate::view::search_text::changes(search, variant);
    out.description = format!("Variant {k} of {}: {changes}", out.name);
    out.name = format!("{}-variant-{k}", out.name);
    // Options are gone, and their names with them.
    out.joint_types
        .retain(|t| t.name == "custom" || JointType::from_name(&t.name).is_some());
    out
}
