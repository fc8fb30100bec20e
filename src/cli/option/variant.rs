//! The k-th variant of the list that a search gives.

use crate::cli::terminal::progress::note;
use crate::model::mechanism::Mechanism;
use crate::score::outcome::variant::Variant;
use crate::score::request::{Check, List, Request};
use crate::score::run::{Event, run};
use anyhow::{Context, ensure};
use clap::Args as ClapArgs;

/// Which of a search's list is meant.
#[derive(Debug, ClapArgs)]
#[group(id = "chosen", multiple = false)]
pub(in crate::cli) struct Chosen {
    /// Variant K of the list that `ozols search FILE` gives, with the same of the options below.
    #[arg(long, value_name = "K")]
    variant: Option<usize>,
    /// The first variant of idea K, as short texts of `ozols search FILE` number them: --distinct --variant K.
    #[arg(long, value_name = "K")]
    idea: Option<usize>,
}

impl Chosen {
    /// Its place in the list, where one is meant.
    pub(in crate::cli) fn place(&self) -> Option<usize> {
        self.variant.or(self.idea)
    }

    /// The request whose list it is of.
    pub(in crate::cli) fn of(&self, request: Request) -> Request {
        Request {
            distinct: request.distinct || self.idea.is_some(),
            ..request
        }
    }
}

/// What `with` makes of variant `k` of the list that `ozols search` gives for the same request: the cheapest first, or in
/// the order of the ranking that the file or the request asks for.
pub(in crate::cli) fn kth<T>(
    mechanism: Mechanism,
    request: Request,
    k: usize,
    with: impl FnOnce(&Variant<'_>) -> T,
) -> anyhow::Result<T> {
    kth_telling(mechanism, request, k, &mut { tell }, with)
}

/// Says the notes of a search on standard error.
pub(in crate::cli) fn tell(event: Event) {
    if let Event::Note(text) = event {
        note(text);
    }
}

/// The same, with what is to be told in other hands.
pub(in crate::cli) fn kth_telling<T>(
    mechanism: Mechanism,
    request: Request,
    k: usize,
    tell: &mut (dyn FnMut(Event) + Send),
    with: impl FnOnce(&Variant<'_>) -> T,
) -> anyhow::Result<T> {
    let one = request.one();
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
