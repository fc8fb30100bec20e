//! The ranking that a search was asked for.

use super::args::Question;
use crate::model::ranking::{Ranking, Term};
use crate::score::evaluate::Evaluator;
use crate::score::ranking::{RankedPool, rank};
use crate::search::building::Diagrams;
use crate::search::diagram::Stop;
use crate::search::request::Search;
use anyhow::{Context, bail, ensure};
use std::ops::ControlFlow;

/// Largest pool.
const MOST: usize = 100_000_000;

/// The ranking of the file, with the terms of the command line where it names some; `None` where neither asks for one.
fn wanted(search: &Search<'_>, a: &Question) -> anyhow::Result<Option<Ranking>> {
    let file = search.mechanism.ranking.clone();
    if a.rank.is_empty() {
        return Ok(file);
    }
    let mut ranking = file.unwrap_or_default();
    ranking.terms.clear();
    for word in &a.rank {
        let (name, weight) = match word.split_once('=') {
            Some((name, weight)) => (name, weight.parse::<f64>().ok()),
            None => (word.as_str(), Some(1.0)),
        };
        let Some(term) = Term::from_name(name) else {
            let known: Vec<&str> = Term::ALL.iter().map(|t| t.name()).collect();
            bail!(
                "--rank: unknown term \"{name}\"; known: {}",
                known.join(", ")
            );
        };
        match weight.filter(|w| (0.0..=1e12).contains(w)) {
            Some(weight) => ranking.terms.push((term, weight)),
            None => bail!("--rank {word}: give a weight from 0 to 1e12, such as {name}=1"),
        }
    }
    Ok(Some(ranking))
}

/// Scores the cheapest variants and puts the best `top` in order, where that was asked for.
pub(super) fn pool(
    search: &Search<'_>,
    diagrams: &Diagrams,
    a: &Question,
    top: usize,
) -> anyhow::Result<Option<RankedPool>> {
    let Some(ranking) = wanted(search, a)? else {
        return Ok(None);
    };
    ensure!(
        (1..=MOST).contains(&a.pool),
        "--pool must be from 1 to {MOST}"
    );
    let evaluator = Evaluator::new(search, ranking.clearance)
        .with_context(|| format!("cannot score variants of {}", search.mechanism.name))?;
    let mut variants = Vec::new();
    search.cheapest(diagrams, a.pool + 1, |v| {
        variants.push(v);
        ControlFlow::Continue(())
    });
    let exhausted = diagrams.stop() == Stop::Exhausted;
    let all = exhausted && variants.len() <= a.pool;
    variants.truncate(a.pool);
    // Further poses may drop some of the best, so that others must stand by.
    let top = if a.generic_only { a.pool } else { top };
    let mut out = rank(&evaluator, &ranking, &variants, a.pool, all, top);
    if !exhausted {
        (out.proven, out.proof) = (false, "the search stopped early");
    }
    Ok(Some(out))
}
