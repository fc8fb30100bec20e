//! What structures and layouts of every kind say of themselves in the tables.

use crate::chains::graph6;
use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::chains::pairs::census::Kinds;
use crate::chains::pairs::chain::{PairChain, ordered};
use crate::chains::pairs::classics::{Classic, MadeAs, classics_of};
use crate::chains::pairs::roles::PairRoles;
use crate::chains::pairs::structure::PairStructure;
use crate::synthesis::layout::Layout;
use crate::synthesis::layout_quality::Looks;
use crate::synthesis::paired::layout::PairLayout;
use crate::synthesis::paired::structure::PairedStructure;
use crate::synthesis::paired::threefold::ThreefoldStructure;
use crate::synthesis::place::Point;
use crate::synthesis::structure::Structure;
use crate::synthesis::task::Limits;

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

/// A structure that is entered in a catalogue.
pub(super) trait Entered {
    /// What the tables say of it.
    fn columns(&self) -> StructureColumns;
}

impl Entered for Structure {
    fn columns(&self) -> StructureColumns {
        let r = &self.roles;
        StructureColumns {
            id: self.id(),
            name: self.name(),
            chain: graph6::write(&self.chain),
            links: self.chain.links(),
            joints: self.chain.joint_count(),
            frame: r.frame,
            driver: r.driver,
            jaws: r.jaws.clone(),
            input: self.form.input,
            symmetry: self.form.symmetry.name().to_owned(),
            parallel: self.form.parallel,
            pairs: None,
            classics: classics_of(&self.pairs().key(), MadeAs::default()).collect(),
        }
    }
}

impl Structure {
    /// The same as a structure of pairs.
    fn pairs(&self) -> PairStructure {
        let r = &self.roles;
        let input = ordered([r.frame, r.driver]);
        let slide = (self.form.input == Input::Slide).then_some(input);
        PairStructure {
            chain: PairChain::hinged(&self.chain, slide),
            roles: PairRoles {
                frame: r.frame,
                input,
                jaws: r.jaws.clone(),
            },
        }
    }
}

impl Entered for PairedStructure {
    fn columns(&self) -> StructureColumns {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let [driven_from, driver] = self.drive();
        StructureColumns {
            id: self.id(),
            name: self.name(),
            chain: graph6::write(&chain.graph()),
            links: chain.links(),
            joints: chain.joints_made().len(),
            frame: roles.frame,
            driver,
            jaws: roles.jaws.clone(),
            input: self.input(),
            symmetry: self.form.symmetry_name(),
            parallel: self.form.parallel,
            pairs: Some(PairColumns {
                code: chain.code(),
                kinds: Kinds::of(chain).with_flat(self.flat_slots().len()),
                driven_from,
            }),
            classics: classics_of(&self.structure.key(), self.made_as()).collect(),
        }
    }
}

impl Entered for ThreefoldStructure {
    fn columns(&self) -> StructureColumns {
        let chain = self.chain();
        let [base, driver] = self.two.drive();
        let link = |l: usize| self.link(l, 0).unwrap_or(0);
        let flat = self.two.flat_slots();
        let flat = flat.iter().map(|j| self.copies(j)).sum();
        StructureColumns {
            id: self.id(),
            name: self.name(),
            chain: graph6::write(&chain.graph()),
            links: self.links(),
            joints: chain.joints_made().len(),
            frame: link(self.two.structure.roles.frame),
            driver: link(driver),
            jaws: self.jaws(),
            input: self.two.input(),
            symmetry: Symmetry::Threefold.name().to_owned(),
            parallel: self.two.form.parallel,
            pairs: Some(PairColumns {
                code: chain.code(),
                kinds: Kinds::of(&chain).with_flat(flat),
                driven_from: link(base),
            }),
            classics: classics_of(&self.two.structure.key(), self.two.made_as()).collect(),
        }
    }
}

/// What a layout was taken for.
pub(super) struct LayoutBasis<'a> {
    /// The figures.
    pub(super) looks: &'a Looks,
    /// What it was made for.
    pub(super) limits: &'a Limits,
    /// The start it was found from.
    pub(super) start: u32,
}

/// Places of a structure, whatever joins its links.
pub(super) trait LaidOut {
    /// What it was taken for.
    fn taken(&self) -> LayoutBasis<'_>;

    /// Where its joints and tips are.
    fn points(&self) -> Vec<Point>;
}

impl LaidOut for Layout {
    fn taken(&self) -> LayoutBasis<'_> {
        let (looks, limits, start) = (&self.looks, &self.limits, self.start);
        LayoutBasis {
            looks,
            limits,
            start,
        }
    }

    fn points(&self) -> Vec<Point> {
        let all = self.at.iter().chain(&self.tips);
        all.map(|p| p.real()).collect()
    }
}

impl LaidOut for PairLayout {
    fn taken(&self) -> LayoutBasis<'_> {
        let (looks, limits, start) = (&self.looks, &self.limits, self.start);
        LayoutBasis {
            looks,
            limits,
            start,
        }
    }

    fn points(&self) -> Vec<Point> {
        self.at.points.clone()
    }
}
