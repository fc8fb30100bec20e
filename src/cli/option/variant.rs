//! Selecting one variant of the list of a search.

use crate::cli::terminal::progress::print_line;
use crate::model::mechanism::Mechanism;
use crate::score::outcome::variant::Variant;
use crate::score::request::{Check, List, Request};
use crate::score::run::{Event, run};
use anyhow::{Context, ensure};
use clap::Args as ClapArgs;

/// Selects a variant of the list of a search.
#[derive(Debug, ClapArgs)]
#[group(id = "chosen", multiple = false)]
pub(crate) struct Chosen {
    /// Variant K of the list that `ozols search FILE` prints with the same options below.
    #[arg(long, value_name = "K")]
    variant: Option<usize>,
    /// First variant of idea K, as numbered in short texts of `ozols search FILE`; the same as --distinct --variant K.
    #[arg(long, value_name = "K")]
    idea: Option<usize>,
}

impl Chosen {
    /// Returns its place in the list, if one is selected.
    pub(crate) fn list_place(&self) -> Option<usize> {
        self.variant.or(self.idea)
    }

    /// Returns the request for its list.
    pub(crate) fn list_request(&self, request: Request) -> Request {
        Request {
            distinct: request.distinct || self.idea.is_some(),
            ..request
        }
    }
}

/// Calls `with` on variant `k` of the list that `ozols search` prints for the same request: the cheapest first, or in the order
/// of the ranking that the file or the request asks for.
pub(crate) fn with_variant<T>(
    mechanism: Mechanism,
    request: Request,
    k: usize,
    with: impl FnOnce(&Variant<'_>) -> T,
) -> anyhow::Result<T> {
    kth_telling(mechanism, request, k, &mut { print_note }, with)
}

/// Says the notes of a search on standard error.
pub(crate) fn print_note(event: Event) {
    if let Event::Note(text) = event {
        print_line(text);
    }
}

/// Does the same as [`kth`], with a given receiver of events.
pub(crate) fn kth_telling<T>(
    mechanism: Mechanism,
    request: Request,
    k: usize,
    tell: &mut (dyn FnMut(Event) + Send),
    with: impl FnOnce(&Variant<'_>) -> T,
) -> anyhow::Result<T> {
    let one = request.noun_of_one();
    ensure!(k > 0, "{one}s are numbered from 1");
    let request = Request {
        list: List::Top(k),
        check: Check::None,
        ..request
    };
    let outcome = run(mechanism, &request, &|| false, tell)?;
    let last = outcome.variants().last();
    let seen = last.as_ref().map_or(0, Variant::position);
    let variant = last.filter(|_| seen == k).with_context(|| {
        let name = &outcome.search.mechanism.name;
        format!("{name} has no {one} {k}: the search gives {seen}")
    })?;
    Ok(with(&variant))
}
