//! Builds every structure of a specification in parallel.

use crate::catalog::RowError;
use crate::catalog::general::{General, InputPair};
use crate::catalog::row::{StructureRow, row_of_pair};
use crate::catalog::spec::{MOST_PAIRED, Spec, SpecError};
use crate::chains::PairKind;
use crate::chains::enumerate::{ChainsError, list_chains};
use crate::chains::roles::Subject;
use crate::chains::sharing::Menu;
use crate::shard::Shard;
use crate::synthesis::layout::known_schemes;
use crate::synthesis::structure::Structure;
use crate::synthesis::structure::listed::{
    generic_structures, hinged_structures, symmetric_structures,
};
use itertools::Itertools;
use rayon::prelude::*;
use std::ops::{ControlFlow, RangeInclusive};
use std::sync::{Mutex, PoisonError};
use thiserror::Error;

/// Why a catalogue cannot be built.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// The specification is wrong.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// Chains that are not listed.
    #[error(transparent)]
    Chains(#[from] ChainsError),
    /// A row failed.
    #[error(transparent)]
    Row(#[from] RowError),
}

/// The structures to be built. Structures that share one search are in one group.
#[derive(Debug)]
pub struct Work {
    structures: Vec<(Option<InputPair>, Vec<Structure>)>,
}

impl Work {
    /// Returns the number of structures.
    #[must_use]
    pub fn structure_count(&self) -> usize {
        self.structures.iter().map(|(_, all)| all.len()).sum()
    }

    /// Returns the ids of the structures.
    pub fn structure_ids(&self) -> impl Iterator<Item = String> + '_ {
        let all = self.structures.iter().flat_map(|(_, all)| all);
        all.map(Structure::id)
    }
}

/// Returns the structures of a part of a specification.
///
/// # Errors
/// Returns an error if the specification is wrong.
///
/// # Examples
/// ```
/// use ozols::{catalog::{build::plan_work, spec::Spec}, shard::Shard};
/// let count = |shard| plan_work(&Spec::default(), shard).map(|w| w.structure_count());
/// // Every structure is in one of two shards.
/// let halves = count(Shard::nth_of(1, 2)?)? + count(Shard::nth_of(2, 2)?)?;
/// assert_eq!(halves, count(Shard::WHOLE)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn plan_work(spec: &Spec, shard: Shard) -> Result<Work, BuildError> {
    let mut all = if spec.classics {
        known_structures(spec)
    } else {
        let mut all = paired_work(spec)?;
        all.extend(threefold_work(spec)?);
        all.extend(hinged_work(spec)?);
        all
    };
    all.retain(|s| shard.has_piece(&s.name()));
    let together = all.into_iter().into_group_map_by(InputPair::of_structure);
    Ok(Work {
        structures: together
            .into_iter()
            .sorted_by(|a, b| a.0.cmp(&b.0))
            .collect(),
    })
}

/// Returns the well-known schemes, or for three jaws the grippers that are made of them.
fn known_structures(spec: &Spec) -> Vec<Structure> {
    let all = known_schemes().into_iter();
    match spec.jaws {
        2 => all.collect(),
        _ => all.filter_map(Structure::three_jawed).collect(),
    }
}

fn paired_work(spec: &Spec) -> Result<Vec<Structure>, BuildError> {
    let forms = spec.paired_forms();
    if forms.is_empty() {
        return Ok(Vec::new());
    }
    let links = spec.link_range()?;
    let of_pairs = Pairs::new(spec);
    let symmetric = (spec.jaws == 2).then(|| of_pairs.two_jawed(links.clone()));
    let generic = (spec.generic_pairs).then(|| of_pairs.generic_structures(links, spec.jaws));
    let all = symmetric.into_iter().flatten();
    let all = all.chain(generic.into_iter().flatten());
    let all = all.flat_map(Structure::with_parallelograms);
    let all = all.filter(|p| forms.contains(&(p.drive_input(), p.form)));
    // Structures that have only hinges except for the input are listed by `hinged_work`.
    Ok(all.filter(|p| !p.is_hinged()).collect())
}

/// Components of structures of pairs.
struct Pairs {
    kinds: Vec<PairKind>,
    most: usize,
    /// Whether a sliding drive is the only pair that is asked for besides hinges.
    hinged: bool,
}

impl Pairs {
    fn new(spec: &Spec) -> Pairs {
        let hinged = spec.pairs.is_empty();
        let kinds = if hinged {
            vec![PairKind::Slide]
        } else {
            spec.pairs.clone()
        };
        Pairs {
            kinds,
            most: spec.at_most,
            hinged,
        }
    }

    /// Returns the structures of the given numbers of links and jaws, laid out without a symmetry.
    fn generic_structures(
        &self,
        links: RangeInclusive<usize>,
        jaws: usize,
    ) -> impl Iterator<Item = Structure> {
        let (kinds, most) = (&self.kinds, self.most);
        links.flat_map(move |n| generic_structures(n, jaws, Menu { kinds, most }))
    }

    /// Returns the symmetric structures of two jaws that have the given numbers of links.
    fn two_jawed(&self, links: RangeInclusive<usize>) -> impl Iterator<Item = Structure> {
        let (kinds, most) = (&self.kinds, self.most);
        let all = links.flat_map(move |n| symmetric_structures(n, Menu { kinds, most }));
        all.filter(|p| !self.hinged || p.is_hinged())
    }
}

/// Returns the structures of three jaws with the requested numbers of links that are made of structures of two jaws.
fn threefold_work(spec: &Spec) -> Result<Vec<Structure>, BuildError> {
    let forms = spec.threefold_forms();
    if forms.is_empty() {
        return Ok(Vec::new());
    }
    let links = spec.link_range()?;
    let of_pairs = Pairs::new(spec);
    let two = of_pairs.two_jawed(3..=MOST_PAIRED.min(*links.end()));
    let two = two.flat_map(Structure::with_parallelograms);
    let two = two.filter(|p| forms.contains(&(p.drive_input(), p.form)));
    let all = two.filter_map(Structure::three_jawed);
    Ok(all.filter(|t| links.contains(&t.link_count())).collect())
}

fn hinged_work(spec: &Spec) -> Result<Vec<Structure>, BuildError> {
    let forms = spec.hinged_forms();
    let mut out = Vec::new();
    if forms.is_empty() {
        return Ok(out);
    }
    for n in spec.link_range()?.filter(|n| n % 2 == 0) {
        out.par_extend(list_chains(n, 1)?.into_par_iter().flat_map_iter(|chain| {
            let (chain, automorphisms) = chain.canonical_form();
            hinged_structures(&Subject::new(&chain, &automorphisms), spec.jaws, &forms)
        }));
    }
    Ok(out)
}

/// Makes the rows of all structures, except those whose ids `skip` knows, in parallel. Gives each to `done` when it is ready,
/// one at a time. The order depends on the threads; the rows do not. Ends early if `done` breaks.
///
/// # Errors
/// Returns the first failure.
///
/// # Examples
/// ```
/// use ozols::{catalog::{build::{build_rows, plan_work}, spec::Spec}, shard::Shard};
/// use std::ops::ControlFlow;
/// let spec = Spec { links: "4".to_owned(), ..Spec::default() };
/// let work = plan_work(&spec, Shard::WHOLE)?;
/// let mut rows = Vec::new();
/// build_rows(&spec, &work, |_| false, |row| {
///     rows.push(row);
///     ControlFlow::<()>::Continue(())
/// })?;
/// assert_eq!(rows.len(), work.structure_count());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn build_rows<B: Send>(
    spec: &Spec,
    work: &Work,
    skip: impl Fn(&str) -> bool + Sync,
    done: impl FnMut(StructureRow) -> ControlFlow<B> + Send,
) -> Result<Option<B>, BuildError> {
    let done = Mutex::new(done);
    // An end before all rows are built: a break of `done`, or a failure.
    type End<B> = Result<B, BuildError>;
    let failed = |e: RowError| -> End<B> { Err(e.into()) };
    let one = |structure: &Structure, general: Option<&General>| -> Result<(), End<B>> {
        if skip(&structure.id()) {
            return Ok(());
        }
        let row = row_of_pair(structure, spec, general).map_err(failed)?;
        // If another thread panicked in `done`, this one ends with it.
        let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
        match done(row) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(b) => Err(Ok(b)),
        }
    };
    let all = work.structures.par_iter().try_for_each(|(pair, together)| {
        let search = |s: &Structure| General::search_general(s, spec).map_err(failed);
        let mut to_do = together.iter().filter(|s| !skip(&s.id()));
        let shared = match pair {
            Some(_) => to_do.next().map_or(Ok(None), search)?,
            None => None,
        };
        together.par_iter().try_for_each(|s| match pair {
            Some(_) => one(s, shared.as_ref()),
            None if skip(&s.id()) => Ok(()),
            None => one(s, search(s)?.as_ref()),
        })
    });
    match all {
        Ok(()) => Ok(None),
        Err(end) => end.map(Some),
    }
}
