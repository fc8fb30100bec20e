//! What structures and layouts of every kind say of themselves in the tables.

use crate::chains::census::Kinds;
use crate::chains::classics::{Classic, classics_of};
use crate::chains::structure::PairStructure;
use crate::chains::{Input, graph6};
use crate::synthesis::structure::Structure;

/// What the tables say of a structure.
#[derive(Debug, Clone)]
pub(super) struct StructureColumns {
    /// Its short name.
    pub(super) id: String,
    /// Its whole name.
    pub(super) name: String,
    /// The code of the graph of its links and joints.
    pub(super) chain: String,
    /// Links.
    pub(super) links: usize,
    /// Joints.
    pub(super) joints: usize,
    /// The link that stands still.
    pub(super) frame: usize,
    /// The link that is driven.
    pub(super) driver: usize,
    /// Two or three.
    pub(super) jaws: Vec<usize>,
    /// How the driver moves.
    pub(super) input: Input,
    /// How it lies on itself, in a word.
    pub(super) symmetry: String,
    /// Whether its jaws stand on parallelograms.
    pub(super) parallel: bool,
    /// Its pairs, where they are not hinges and a driver that slides in the frame.
    pub(super) pairs: Option<PairColumns>,
    /// Well-known schemes of this structure, or of two of its three sides.
    pub(super) classics: Vec<&'static Classic>,
}

/// What the tables say of the pairs of a structure.
#[derive(Debug, Clone)]
pub(super) struct PairColumns {
    /// A letter for each two links.
    pub(super) code: String,
    /// How many are no hinges.
    pub(super) kinds: Kinds,
    /// The link that the driver moves against.
    pub(super) driven_from: usize,
}

impl StructureColumns {
    pub(super) fn of(structure: &Structure) -> StructureColumns {
        let PairStructure { chain, roles } = structure.whole();
        let link = |l: usize| structure.link(l, 0).unwrap_or(0);
        let [driven_from, driver] = structure.structure.roles.drive().map(link);
        let flat = structure.flat_slots();
        let flat = flat.iter().map(|j| structure.copies(j)).sum();
        let pairs = PairColumns {
            code: chain.code(),
            kinds: Kinds::of(&chain).with_flat(flat),
            driven_from,
        };
        let key = structure.structure.key();
        StructureColumns {
            id: structure.id(),
            name: structure.name(),
            chain: graph6::write(&chain),
            links: chain.links(),
            joints: chain.joints_made().len(),
            frame: roles.frame,
            driver,
            jaws: roles.jaws,
            input: structure.input(),
            symmetry: structure.symmetry_name(),
            parallel: structure.form.parallel,
            pairs: (!structure.form.hinges).then_some(pairs),
            classics: classics_of(&key, structure.made_as()).collect(),
        }
    }
}
