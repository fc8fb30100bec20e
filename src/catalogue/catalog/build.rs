//! Every structure of a specification, in parallel, each given when it is done.

use crate::catalog::general::{General, InputPair};
use crate::catalog::row::{RowError, StructureRow, row_of_pair};
use crate::catalog::spec::Spec;
use crate::chains::chain::Chain;
use crate::chains::enumerate::{ChainsError, chains};
use crate::chains::roles::Subject;
use crate::shard::Shard;
use crate::synthesis::structure::{Structure, structures};
use itertools::Itertools;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::Mutex;
use thiserror::Error;

/// Why a catalogue cannot be built.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Chains that are not listed.
    #[error(transparent)]
    Chains(#[from] ChainsError),
    /// A row failed.
    #[error(transparent)]
    Row(#[from] RowError),
}

/// A chain with its automorphisms and the structures that are asked of it.
#[derive(Debug)]
pub struct Work {
    chain: Chain,
    automorphisms: Vec<Vec<usize>>,
    /// The structures.
    pub structures: Vec<Structure>,
}

impl Work {
    /// The structures, those together that have a search in common.
    fn by_pair(&self) -> Vec<Vec<&Structure>> {
        let pairs = self
            .structures
            .iter()
            .into_group_map_by(|s| InputPair::of(s));
        pairs
            .into_iter()
            .sorted_by_key(|(pair, _)| *pair)
            .map(|(_, of)| of)
            .collect()
    }
}

/// The structures of a part of a specification, by chains, in the order of their codes.
///
/// # Errors
/// Where the specification is wrong.
pub fn work(spec: &Spec, shard: Shard) -> Result<Vec<Work>, BuildError> {
    let forms = spec.forms().map_err(RowError::from)?;
    let mut out = Vec::new();
    for n in spec.links().map_err(RowError::from)?.filter(|n| n % 2 == 0) {
        let all = chains(n, 1)?;
        out.par_extend(all.into_par_iter().map(|chain| {
            let (chain, automorphisms) = chain.canonical();
            let subject = Subject::new(&chain, &automorphisms);
            let mut structures = structures(&subject, spec.jaws, &forms);
            structures.retain(|s| shard.has(&s.name()));
            Work {
                structures,
                automorphisms,
                chain,
            }
        }));
    }
    Ok(out)
}

/// Makes the rows of all structures but those that `skip` knows, in parallel, and gives each to `done` when it is ready,
/// one at a time. Which comes first depends on the threads; what is in a row does not. Ends early where `done` breaks.
///
/// # Errors
/// The first failure.
pub fn build<B: Send>(
    spec: &Spec,
    work: &[Work],
    skip: impl Fn(&Structure) -> bool + Sync,
    done: impl FnMut(StructureRow) -> ControlFlow<B> + Send,
) -> Result<Option<B>, BuildError> {
    let done = Mutex::new(done);
    let one = |w: &Work, structure: &Structure, general: Option<&General>| {
        if skip(structure) {
            return Ok(());
        }
        let subject = Subject::new(&w.chain, &w.automorphisms);
        let row = row_of_pair(&subject, structure, spec, general);
        let row = row.map_err(|e| Some(Err(BuildError::Row(e))))?;
        let Ok(mut done) = done.lock() else {
            return Err(None);
        };
        match done(row) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(b) => Err(Some(Ok(b))),
        }
    };
    let all = work.par_iter().flat_map(|w| {
        let together = w.by_pair().into_par_iter();
        together.map(move |together| (w, together))
    });
    let ended = all.try_for_each(|(w, together)| {
        let Some(first) = together.iter().find(|s| !skip(s)) else {
            return Ok(());
        };
        let general = General::of(first, spec).map_err(|e| Some(Err(BuildError::Row(e))))?;
        let each = together.par_iter();
        each.try_for_each(|s| one(w, s, general.as_ref()))
    });
    match ended {
        Ok(()) | Err(None) => Ok(None),
        Err(Some(Ok(b))) => Ok(Some(b)),
        Err(Some(Err(e))) => Err(e),
    }
}
