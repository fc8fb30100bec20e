//! The k-th variant of the list that a search gives.

use super::progress::note;
use crate::model::mechanism::Mechanism;
use crate::score::request::{Check, List, Request};
use crate::score::run::{Event, run};
use crate::score::variant::Variant;
use anyhow::{Context, ensure};

/// What `with` makes of variant `k` of the list that `ozols search` gives for the same request: the cheapest first, or in
/// the order of the ranking that the file or the request asks for.
pub(super) fn kth<T>(
    mechanism: Mechanism,
    request: Request,
    k: usize,
    with: impl FnOnce(&Variant<'_>) -> T,
) -> anyhow::Result<T> {
    ensure!(k > 0, "variants are numbered from 1");
    let request = Request {
        list: List::Top(k),
        check: Check::None,
        ..request
    };
    let tell = &mut |event| {
        if let Event::Note(text) = event {
            note(text);
        }
    };
    let outcome = run(mechanism, &request, &|| false, tell)?;
    let last = outcome.variants().last();
    let seen = last.as_ref().map_or(0, Variant::position);
    let variant = last.filter(|_| seen == k).with_context(|| {
        let name = &outcome.search.mechanism.name;
        format!("{name} has no variant {k}: the search gives {seen}")
    })?;
    Ok(with(&variant))
}
