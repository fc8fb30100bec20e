//! Every structure of a specification, in parallel, each given when it is done.

use crate::catalog::RowError;
use crate::catalog::general::{General, InputPair};
use crate::catalog::paired_row::{PairedRow, ThreefoldRow, row_of_paired, row_of_three};
use crate::catalog::row::{StructureRow, row_of_pair};
use crate::catalog::spec::{MOST_PAIRED, Spec};
use crate::chains::Chain;
use crate::chains::enumerate::{ChainsError, chains};
use crate::chains::pairs::PairKind;
use crate::chains::pairs::sharing::Menu;
use crate::chains::roles::Subject;
use crate::shard::Shard;
use crate::synthesis::paired::layout::known_schemes;
use crate::synthesis::paired::structure::{PairedStructure, generic_structures, paired_structures};
use crate::synthesis::paired::threefold::ThreefoldStructure;
use crate::synthesis::structure::{Structure, structures};
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

/// What is to be built.
#[derive(Debug)]
pub struct Work {
    /// Structures of hinges, by their chains, in the order of their codes.
    chains: Vec<ChainWork>,
    /// Structures with slides, gears and slots.
    paired: Vec<PairedStructure>,
    /// Those with three jaws, threefold.
    threefold: Vec<ThreefoldStructure>,
}

/// A chain with its automorphisms and the structures that are asked of it.
#[derive(Debug)]
struct ChainWork {
    chain: Chain,
    automorphisms: Vec<Vec<usize>>,
    structures: Vec<Structure>,
}

/// A row of a catalogue.
#[derive(Debug, Clone)]
pub enum CatalogueRow {
    /// Of a structure of hinges.
    Hinged(Box<StructureRow>),
    /// Of one with slides, gears or slots.
    Paired(Box<PairedRow>),
    /// Of one with three jaws.
    Threefold(Box<ThreefoldRow>),
}

impl ChainWork {
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

impl Work {
    /// How many structures there are.
    #[must_use]
    pub fn count(&self) -> usize {
        let hinged = self.chains.iter().map(|w| w.structures.len());
        hinged.sum::<usize>() + self.paired.len() + self.threefold.len()
    }

    /// The ids of the structures.
    pub fn ids(&self) -> impl Iterator<Item = String> + '_ {
        let hinged = self.chains.iter().flat_map(|w| &w.structures);
        let paired = self.paired.iter().map(PairedStructure::id);
        let threefold = self.threefold.iter().map(ThreefoldStructure::id);
        hinged.map(Structure::id).chain(paired).chain(threefold)
    }
}

/// The structures of a part of a specification.
///
/// # Errors
/// Where the specification is wrong.
pub fn work(spec: &Spec, shard: Shard) -> Result<Work, BuildError> {
    Ok(Work {
        chains: chain_work(spec, shard)?,
        paired: paired_work(spec, shard)?,
        threefold: threefold_work(spec, shard)?,
    })
}

fn paired_work(spec: &Spec, shard: Shard) -> Result<Vec<PairedStructure>, BuildError> {
    if spec.classics {
        let two = spec.jaws == 2;
        let all = known_schemes().into_iter().filter(|_| two);
        return Ok(all.filter(|p| shard.has(&p.name())).collect());
    }
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
    let all = all.flat_map(PairedStructure::with_parallelograms);
    let all = all.filter(|p| forms.contains(&(p.input(), p.form)));
    // Those of hinges alone are made as such.
    let asked = all.flat_map(|p| of_pairs.made(p));
    let asked = asked.filter(|p| p.form.one_pin != 0 || !p.is_hinged());
    Ok(asked.filter(|p| shard.has(&p.name())).collect())
}

/// What structures of pairs are made of.
struct Pairs {
    kinds: Vec<PairKind>,
    most: usize,
    /// Whether no pairs are asked for but a drive that slides.
    hinged: bool,
    /// Whether hinges on one pin are asked for, where one of both is.
    one_pin: Option<bool>,
    /// The same of flat faces.
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

    /// A structure in the ways it is to be made.
    fn made(&self, p: PairedStructure) -> impl Iterator<Item = PairedStructure> {
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

    /// The structures of so many links and jaws laid out without a symmetry.
    fn generic(
        &self,
        links: RangeInclusive<usize>,
        jaws: usize,
    ) -> impl Iterator<Item = PairedStructure> {
        let (kinds, most) = (&self.kinds, self.most);
        links.flat_map(move |n| generic_structures(n, jaws, Menu { kinds, most }))
    }

    /// The symmetric structures of two jaws of so many links.
    fn two_jawed(&self, links: RangeInclusive<usize>) -> impl Iterator<Item = PairedStructure> {
        let (kinds, most) = (&self.kinds, self.most);
        let all = links.flat_map(move |n| paired_structures(n, Menu { kinds, most }));
        all.filter(|p| !self.hinged || p.is_hinged())
    }
}

/// Those of three jaws that have as many links as is asked.
fn threefold_work(spec: &Spec, shard: Shard) -> Result<Vec<ThreefoldStructure>, BuildError> {
    let has = |t: &ThreefoldStructure| shard.has(&t.name());
    if spec.classics && spec.jaws == 3 {
        let all = known_schemes().into_iter();
        let all = all.filter_map(|p| ThreefoldStructure::new(&p));
        return Ok(all.filter(has).collect());
    }
    let forms = spec.threefold_forms().map_err(RowError::from)?;
    if spec.classics || forms.is_empty() {
        return Ok(Vec::new());
    }
    let links = spec.links().map_err(RowError::from)?;
    let of_pairs = Pairs::new(spec)?;
    // A side more makes more links of them.
    let two = of_pairs.two_jawed(3..=MOST_PAIRED.min(*links.end()));
    let two = two.flat_map(PairedStructure::with_parallelograms);
    let two = two.filter(|p| forms.contains(&(p.input(), p.form)));
    let two = two.flat_map(|p| of_pairs.made(p));
    let all = two.filter_map(|p| ThreefoldStructure::new(&p));
    Ok(all
        .filter(|t| links.contains(&t.links()) && has(t))
        .collect())
}

fn chain_work(spec: &Spec, shard: Shard) -> Result<Vec<ChainWork>, BuildError> {
    let forms = spec.forms().map_err(RowError::from)?;
    let mut out = Vec::new();
    if forms.is_empty() || spec.classics {
        return Ok(out);
    }
    for n in spec.links().map_err(RowError::from)?.filter(|n| n % 2 == 0) {
        let all = chains(n, 1)?;
        out.par_extend(all.into_par_iter().map(|chain| {
            let (chain, automorphisms) = chain.canonical();
            let subject = Subject::new(&chain, &automorphisms);
            let mut structures = structures(&subject, spec.jaws, &forms);
            structures.retain(|s| shard.has(&s.name()));
            ChainWork {
                structures,
                automorphisms,
                chain,
            }
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
    done: impl FnMut(CatalogueRow) -> ControlFlow<B> + Send,
) -> Result<Option<B>, BuildError> {
    let done = Mutex::new(done);
    let give = |row: CatalogueRow| -> Result<(), BuildEnd<B>> {
        let Ok(mut done) = done.lock() else {
            return Err(BuildEnd::Poisoned);
        };
        match done(row) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(b) => Err(BuildEnd::Asked(b)),
        }
    };
    let paired = || {
        work.paired.par_iter().try_for_each(|p| {
            if skip(&p.id()) {
                return Ok(());
            }
            let row = row_of_paired(p, spec).map_err(BuildEnd::failed)?;
            give(CatalogueRow::Paired(Box::new(row)))
        })
    };
    let threefold = || {
        work.threefold.par_iter().try_for_each(|t| {
            if skip(&t.id()) {
                return Ok(());
            }
            let row = row_of_three(t, spec).map_err(BuildEnd::failed)?;
            give(CatalogueRow::Threefold(Box::new(row)))
        })
    };
    let one = |w: &ChainWork, structure: &Structure, general: Option<&General>| {
        if skip(&structure.id()) {
            return Ok(());
        }
        let subject = Subject::new(&w.chain, &w.automorphisms);
        let row = row_of_pair(&subject, structure, spec, general).map_err(BuildEnd::failed)?;
        give(CatalogueRow::Hinged(Box::new(row)))
    };
    let hinged = || {
        let all = work.chains.par_iter().flat_map(|w| {
            let together = w.by_pair().into_par_iter();
            together.map(move |together| (w, together))
        });
        all.try_for_each(|(w, together)| {
            let Some(first) = together.iter().find(|s| !skip(&s.id())) else {
                return Ok(());
            };
            let general = General::of(first, spec).map_err(BuildEnd::failed)?;
            let each = together.par_iter();
            each.try_for_each(|s| one(w, s, general.as_ref()))
        })
    };
    let all = paired().and_then(|()| threefold()).and_then(|()| hinged());
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
