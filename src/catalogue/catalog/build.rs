//! Every structure of a specification, in parallel, each given when it is done.

use crate::catalog::RowError;
use crate::catalog::general::{General, InputPair};
use crate::catalog::row::{StructureRow, row_of_pair};
use crate::catalog::spec::{MOST_PAIRED, Spec};
use crate::chains::PairKind;
use crate::chains::enumerate::{ChainsError, chains};
use crate::chains::roles::Subject;
use crate::chains::sharing::Menu;
use crate::shard::Shard;
use crate::synthesis::layout::known_schemes;
use crate::synthesis::listed::{generic_structures, hinged_structures, symmetric_structures};
use crate::synthesis::structure::Structure;
use itertools::Itertools;
use rayon::prelude::*;
use std::ops::{ControlFlow, RangeInclusive};
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

/// The structures to be built. Structures that share one search are in one group.
#[derive(Debug)]
pub struct Work {
    structures: Vec<(Option<InputPair>, Vec<Structure>)>,
}

impl Work {
    /// Returns the number of structures.
    #[must_use]
    pub fn count(&self) -> usize {
        self.structures.iter().map(|(_, all)| all.len()).sum()
    }

    /// Returns the ids of the structures.
    pub fn ids(&self) -> impl Iterator<Item = String> + '_ {
        let all = self.structures.iter().flat_map(|(_, all)| all);
        all.map(Structure::id)
    }
}

/// The structures of a part of a specification.
///
/// # Errors
/// Where the specification is wrong.
pub fn work(spec: &Spec, shard: Shard) -> Result<Work, BuildError> {
    let mut all = if spec.classics {
        known(spec)
    } else {
        let mut all = paired_work(spec)?;
        all.extend(threefold_work(spec)?);
        all.extend(hinged_work(spec)?);
        all
    };
    all.retain(|s| shard.has(&s.name()));
    let together = all.into_iter().into_group_map_by(InputPair::of_structure);
    Ok(Work {
        structures: together
            .into_iter()
            .sorted_by(|a, b| a.0.cmp(&b.0))
            .collect(),
    })
}

/// Returns the well-known schemes, or for three jaws the grippers that are made of them.
fn known(spec: &Spec) -> Vec<Structure> {
    let all = known_schemes().into_iter();
    match spec.jaws {
        2 => all.collect(),
        _ => all.filter_map(Structure::thrice).collect(),
    }
}

fn paired_work(spec: &Spec) -> Result<Vec<Structure>, BuildError> {
    let forms = spec.paired_forms().map_err(RowError::from)?;
    if forms.is_empty() {
        return Ok(Vec::new());
    }
    let links = spec.links().map_err(RowError::from)?;
    let of_pairs = Pairs::new(spec)?;
    let symmetric = (spec.jaws == 2).then(|| of_pairs.two_jawed(links.clone()));
    let generic = (spec.generic_pairs).then(|| of_pairs.generic(links, spec.jaws));
    let all = symmetric.into_iter().flatten();
    let all = all.chain(generic.into_iter().flatten());
    let all = all.flat_map(Structure::with_parallelograms);
    let all = all.filter(|p| forms.contains(&(p.input(), p.form)));
    let asked = all.flat_map(|p| of_pairs.made(p));
    // Structures that have only hinges except for the input are listed by `hinged_work`.
    Ok(asked
        .filter(|p| p.form.one_pin != 0 || !p.is_hinged())
        .collect())
}

/// What structures of pairs are made of.
struct Pairs {
    kinds: Vec<PairKind>,
    most: usize,
    /// Whether no pairs are asked for except a drive that slides.
    hinged: bool,
    /// Whether only structures with hinges on one pin are built, or only those without; `None` if both are.
    one_pin: Option<bool>,
    /// Whether only structures with flat faces are built, or only those without; `None` if both are.
    flat_faces: Option<bool>,
}

impl Pairs {
    fn new(spec: &Spec) -> Result<Pairs, BuildError> {
        let mut kinds = spec.pairs().map_err(RowError::from)?;
        let hinged = kinds.is_empty();
        if hinged {
            kinds.push(PairKind::Slide);
        }
        Ok(Pairs {
            kinds,
            most: spec.at_most,
            hinged,
            one_pin: spec.one_pin().map_err(RowError::from)?,
            flat_faces: spec.flat_faces().map_err(RowError::from)?,
        })
    }

    /// Returns a structure in the ways in which it is to be made.
    fn made(&self, p: Structure) -> impl Iterator<Item = Structure> {
        let (one_pin, flat_faces) = (self.one_pin, self.flat_faces);
        let pins = (one_pin != Some(false)).then(|| p.clone().with_one_pins());
        let alone = pins.is_none().then_some(p);
        let all = pins.into_iter().flatten().chain(alone);
        let all = all.flat_map(|p| {
            let flat = p.with_flat_faces();
            std::iter::once(p).chain(flat)
        });
        all.filter(move |p| {
            one_pin.is_none_or(|only| only == (p.form.one_pin != 0))
                && flat_faces.is_none_or(|only| only == p.form.flat)
        })
    }

    /// Returns the structures of the given numbers of links and jaws, laid out without a symmetry.
    fn generic(
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

/// Returns the structures of three jaws that have the numbers of links asked for and are made of structures of two jaws.
fn threefold_work(spec: &Spec) -> Result<Vec<Structure>, BuildError> {
    let forms = spec.threefold_forms().map_err(RowError::from)?;
    if forms.is_empty() {
        return Ok(Vec::new());
    }
    let links = spec.links().map_err(RowError::from)?;
    let of_pairs = Pairs::new(spec)?;
    let two = of_pairs.two_jawed(3..=MOST_PAIRED.min(*links.end()));
    let two = two.flat_map(Structure::with_parallelograms);
    let two = two.filter(|p| forms.contains(&(p.input(), p.form)));
    let two = two.flat_map(|p| of_pairs.made(p));
    let all = two.filter_map(Structure::thrice);
    Ok(all.filter(|t| links.contains(&t.links())).collect())
}

fn hinged_work(spec: &Spec) -> Result<Vec<Structure>, BuildError> {
    let forms = spec.forms().map_err(RowError::from)?;
    let mut out = Vec::new();
    if forms.is_empty() {
        return Ok(out);
    }
    for n in spec.links().map_err(RowError::from)?.filter(|n| n % 2 == 0) {
        out.par_extend(chains(n, 1)?.into_par_iter().flat_map_iter(|chain| {
            let (chain, automorphisms) = chain.canonical();
            hinged_structures(&Subject::new(&chain, &automorphisms), spec.jaws, &forms)
        }));
    }
    Ok(out)
}

/// Makes the rows of all structures but those whose ids `skip` knows, in parallel, and gives each to `done` when it is ready,
/// one at a time. Which comes first depends on the threads; what is in a row does not. Ends early where `done` breaks.
///
/// # Errors
/// The first failure.
pub fn build<B: Send>(
    spec: &Spec,
    work: &Work,
    skip: impl Fn(&str) -> bool + Sync,
    done: impl FnMut(StructureRow) -> ControlFlow<B> + Send,
) -> Result<Option<B>, BuildError> {
    let done = Mutex::new(done);
    let give = |row: StructureRow| -> Result<(), BuildEnd<B>> {
        let Ok(mut done) = done.lock() else {
            return Err(BuildEnd::Poisoned);
        };
        match done(row) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(b) => Err(BuildEnd::Asked(b)),
        }
    };
    let one = |structure: &Structure, general: Option<&General>| {
        if skip(&structure.id()) {
            return Ok(());
        }
        give(row_of_pair(structure, spec, general).map_err(BuildEnd::failed)?)
    };
    let all = work.structures.par_iter().try_for_each(|(_, together)| {
        let Some(first) = together.iter().find(|s| !skip(&s.id())) else {
            return Ok(());
        };
        let general = General::of(first, spec).map_err(BuildEnd::failed)?;
        let each = together.par_iter();
        each.try_for_each(|s| one(s, general.as_ref()))
    });
    all.map_or_else(BuildEnd::told, |()| Ok(None))
}

/// Why building ends before all is built.
enum BuildEnd<B> {
    /// Whoever takes the rows has enough.
    Asked(B),
    /// It panicked.
    Poisoned,
    /// A row failed.
    Failed(BuildError),
}

impl<B> BuildEnd<B> {
    fn failed(e: RowError) -> BuildEnd<B> {
        BuildEnd::Failed(BuildError::Row(e))
    }

    fn told(self) -> Result<Option<B>, BuildError> {
        match self {
            BuildEnd::Poisoned => Ok(None),
            BuildEnd::Asked(b) => Ok(Some(b)),
            BuildEnd::Failed(e) => Err(e),
        }
    }
}
