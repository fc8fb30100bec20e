//! Structures of pairs with the symmetry they are to have.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::chains::pairs::PairKind;
use crate::chains::pairs::census::visit_pair_chains;
use crate::chains::pairs::chain::{Joint, carried, ordered};
use crate::chains::pairs::classics::MadeAs;
use crate::chains::pairs::motion::{Image, Swap, motion, symmetric_ways};
use crate::chains::pairs::roles::PairSubject;
use crate::chains::pairs::sharing::Menu;
use crate::chains::pairs::structure::PairStructure;
use crate::chains::pairs::symmetric_census::symmetric_grippers;
use crate::synthesis::place::Place;
use crate::synthesis::structure::short_id;
use crate::synthesis::task;
use crate::synthesis::task::Task;
use itertools::Itertools;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// A gripper of pairs without places.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PairedStructure {
    /// Chain and roles, in canonical numbering.
    pub structure: PairStructure,
    /// How it is laid out.
    pub form: PairedForm,
}

/// How a structure of pairs is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PairedForm {
    /// Mirror image, half turn or generic.
    pub symmetry: Symmetry,
    /// Whether the symmetry carries the input joint elsewhere, so that it drives one side alone.
    pub one_sided: bool,
    /// Whether each jaw stands on a parallelogram with the frame or a driver that slides in it, so that it does not turn.
    pub parallel: bool,
    /// Whether slots between links that keep their attitude against each other have flat faces: slides, redundant in the plane already.
    pub flat: bool,
    /// Whether a pinion is a screw with a right and a left thread, and its racks are nuts.
    pub threaded: bool,
    /// Hinges that are on one pin with their mirror images, by the places of the first of both among the joints, as bits.
    pub one_pin: u32,
}

impl PairedForm {
    /// A symmetry, driven on both sides, without parallelograms.
    #[must_use]
    pub fn of(symmetry: Symmetry) -> PairedForm {
        PairedForm {
            symmetry,
            one_sided: false,
            parallel: false,
            flat: false,
            threaded: false,
            one_pin: 0,
        }
    }

    /// Whether a joint, the first of two, is on one pin with its image.
    #[must_use]
    pub(super) fn is_on_one_pin(self, joint: usize) -> bool {
        self.one_pin
            .checked_shr(joint as u32)
            .is_some_and(|rest| rest & 1 == 1)
    }

    /// All of it in words, the symmetry first.
    pub(super) fn name(self, symmetry: &str) -> String {
        let parallel = if self.parallel { " parallel" } else { "" };
        let flat = if self.flat { " flat" } else { "" };
        let threaded = if self.threaded { " threaded" } else { "" };
        format!("{symmetry}{parallel}{flat}{threaded}")
    }

    /// The symmetry in a word: "mirror", "mirror-but-input".
    #[must_use]
    pub(crate) fn symmetry_name(self) -> String {
        let but = if self.one_sided { "-but-input" } else { "" };
        format!("{}{but}", self.symmetry.name())
    }
}

/// How a symmetric structure may lie on itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lay {
    /// Where the symmetry carries each link.
    pub swap: Vec<usize>,
    /// A bit for each slide and slot that is its own mirror image, as [`crate::chains::pairs::motion::SymmetricWay`] has them.
    pub bits: u32,
}

impl Lay {
    /// Whether a joint may be on one pin with its image: a hinge of a link that the symmetry keeps with one that it does not.
    #[must_use]
    pub(super) fn may_share(&self, joint: &Joint) -> bool {
        let kept = joint.links.map(|l| self.swap[l] == l);
        joint.pair == PairKind::Hinge && kept[0] != kept[1]
    }
}

impl PairedStructure {
    /// The name that says all of it.
    #[must_use]
    pub fn name(&self) -> String {
        let form = self.form.name(&self.form.symmetry_name());
        let pins = self.on_one_pin();
        let pins = pins.map(|j| format!(" pin{}-{}", j.links[0], j.links[1]));
        format!("{} {form}{}", self.structure.name(), pins.format(""))
    }

    /// The hinges that are on one pin with their images, of both the first.
    fn on_one_pin(&self) -> impl Iterator<Item = Joint> {
        let joints = self.structure.chain.joints_made().into_iter();
        let shared = joints.enumerate();
        let shared = shared.filter(|(i, _)| self.form.is_on_one_pin(*i));
        shared.map(|(_, joint)| joint)
    }

    /// What it is beside its structure.
    #[must_use]
    pub fn made_as(&self) -> MadeAs {
        let roles = &self.structure.roles;
        let at_frame = |j: Joint| j.is_at(roles.frame) && roles.jaws.iter().any(|&a| j.is_at(a));
        MadeAs {
            flat: self.form.flat,
            threaded: self.form.threaded,
            jaws_on_one_pin: self.on_one_pin().any(at_frame),
        }
    }

    /// This, and the same with hinges on one pin with their mirror images, in every way in which no link has two such pins.
    ///
    /// # Complexity
    /// As [`PairedStructure::lays`].
    pub(crate) fn with_one_pins(self) -> impl Iterator<Item = PairedStructure> {
        let joints = self.structure.chain.joints_made();
        let mirror = self.form.symmetry == Symmetry::Mirror;
        let lay = mirror.then(|| self.lays().into_iter().next()).flatten();
        let first = |(i, joint): (usize, &Joint)| {
            let lay = lay.as_ref()?;
            let image = carried(joint.links, &lay.swap);
            let later = joints[i..].iter().any(|j| j.links == image);
            (later && lay.may_share(joint)).then_some(i)
        };
        let shared: Vec<usize> = joints.iter().enumerate().filter_map(first).collect();
        let ways = shared.into_iter().powerset().filter(move |ways| {
            let lay = lay.as_ref();
            let moved = ways.iter().flat_map(|&i| joints[i].links);
            moved
                .filter(|&l| lay.is_some_and(|lay| lay.swap[l] != l))
                .all_unique()
        });
        ways.map(move |ways| PairedStructure {
            form: PairedForm {
                one_pin: ways.iter().fold(0, |bits, i| bits | 1 << i),
                ..self.form
            },
            ..self.clone()
        })
    }

    /// A short name that a shell takes as it is: the number of links, and the beginning of the SHA-256 of the whole name.
    #[must_use]
    pub fn id(&self) -> String {
        short_id(self.structure.chain.links(), &self.name())
    }

    /// Where the tips of the jaws are drawn for a task, in millimetres.
    #[must_use]
    pub fn tips(&self, task: &Task) -> Vec<Place> {
        task::draw_tips(self.structure.roles.jaws.len(), self.form.symmetry, task)
    }

    /// How it is driven.
    #[must_use]
    pub fn input(&self) -> Input {
        if self.structure.slides() {
            Input::Slide
        } else {
            Input::Turn
        }
    }

    /// The link against which the driver moves, the frame where it is one of the two, and the driver.
    #[must_use]
    pub fn drive(&self) -> [usize; 2] {
        let [u, v] = self.structure.roles.input;
        if v == self.structure.roles.frame {
            [v, u]
        } else {
            [u, v]
        }
    }

    /// The ways it may lie on itself in which it moves as a gripper.
    ///
    /// # Complexity
    /// An elimination for each way of each automorphism.
    #[must_use]
    pub fn lays(&self) -> Vec<Lay> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let image = match self.form.symmetry {
            Symmetry::Generic => return self.generic_lay().into_iter().collect(),
            Symmetry::HalfTurn => Image::HalfTurn,
            Symmetry::Mirror | Symmetry::Threefold => Image::Mirror,
        };
        // Those that carry three jaws to each other are made of two of them.
        let &[a, b] = &roles.jaws[..] else {
            return Vec::new();
        };
        let involutions = chain.automorphisms().into_iter().filter(|s| {
            let back = (0..s.len()).all(|l| s[s[l]] == l);
            let keeps = carried(roles.input, s) == roles.input;
            back && keeps != self.form.one_sided && s[roles.frame] == roles.frame && s[a] == b
        });
        if self.form.threaded {
            // A screw turns as its mirror image does, so that nuts of a right and a left thread are each other's image.
            let lay = |swap| Lay { swap, bits: 0 };
            return involutions.map(lay).collect();
        }
        let mut out = Vec::new();
        for swap in involutions {
            let symmetry = Swap {
                links: &swap,
                image,
            };
            let ways = symmetric_ways(chain, symmetry, roles.frame);
            let moving = ways.into_iter().filter(|w| roles.moves_in(&w.motion));
            out.extend(moving.map(|w| Lay {
                swap: swap.clone(),
                bits: w.bits,
            }));
        }
        out
    }

    /// No symmetry, where it moves as a gripper so.
    fn generic_lay(&self) -> Option<Lay> {
        let found = motion(&self.structure.chain)?;
        self.structure.roles.moves_in(&found).then(|| Lay {
            swap: (0..self.structure.chain.links()).collect(),
            bits: 0,
        })
    }

    /// The joints of a parallelogram for each jaw, or `None` where one has none: of two rods those at the base, then those at the
    /// jaw in the same order.
    #[must_use]
    pub fn rings(&self) -> Option<Vec<[[usize; 2]; 4]>> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let [base, driver] = self.drive();
        let sliding = (base == roles.frame && self.structure.slides()).then_some(driver);
        let hinged = |u: usize, v: usize| chain.between(u, v) == Some(PairKind::Hinge);
        let ring = |jaw: usize| {
            let bases = std::iter::once(roles.frame).chain(sliding);
            bases.filter(|b| *b != jaw).find_map(|base| {
                let rod =
                    |l: &usize| hinged(*l, jaw) && hinged(*l, base) && !roles.jaws.contains(l);
                let (p, q) = (0..chain.links()).filter(rod).tuples().next()?;
                Some([[p, base], [q, base], [p, jaw], [q, jaw]].map(ordered))
            })
        };
        roles.jaws.iter().map(|&jaw| ring(jaw)).collect()
    }
}

/// The symmetric structures of so many links that have such pairs.
///
/// # Complexity
/// As [`symmetric_grippers`].
#[must_use]
pub fn paired_structures(links: usize, menu: Menu<'_>) -> Vec<PairedStructure> {
    let all = symmetric_grippers(links, menu).into_iter();
    all.map(|g| PairedStructure {
        structure: g.structure,
        form: PairedForm::of(if g.kind.half_turn {
            Symmetry::HalfTurn
        } else {
            Symmetry::Mirror
        }),
    })
    .collect()
}

/// Every essential structure of so many links and jaws that has such pairs, laid out without a symmetry.
///
/// # Complexity
/// As [`visit_pair_chains`], and a canonical numbering for each.
#[must_use]
pub fn generic_structures(links: usize, jaws: usize, menu: Menu<'_>) -> Vec<PairedStructure> {
    let all = Mutex::new(BTreeSet::new());
    visit_pair_chains(links, menu, &|subject| {
        let drives = subject.drives().into_iter();
        let roles = drives.flat_map(|(frame, input)| subject.grippers(frame, &input, jaws));
        let essential = roles.filter(|r| subject.is_essential(r));
        let keys = essential.map(|roles| {
            let chain = subject.chain.clone();
            PairStructure { chain, roles }.key()
        });
        // Numbered before others have to wait.
        let keys: Vec<_> = keys.collect();
        all.lock()
            .unwrap_or_else(PoisonError::into_inner)
            .extend(keys);
    });
    let all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    let structure = |key| PairedStructure {
        structure: PairStructure::of_key(&key),
        form: PairedForm::of(Symmetry::Generic),
    };
    all.into_iter().map(structure).collect()
}

impl PairedStructure {
    /// Whether an automorphism keeps frame and input joint and carries each jaw to the next, back after as many times as there are
    /// jaws: it swaps two.
    #[must_use]
    pub fn is_graph_symmetric(&self) -> bool {
        let chain = &self.structure.chain;
        let automorphisms = chain.automorphisms();
        let automorphisms: Vec<&Vec<usize>> = automorphisms.iter().collect();
        let subject = PairSubject::new(chain, &automorphisms);
        subject.is_graph_symmetric(&self.structure.roles)
    }

    pub(super) fn on_parallelograms_if_any(self) -> PairedStructure {
        let parallel = self.rings().is_some();
        PairedStructure {
            form: PairedForm {
                parallel,
                ..self.form
            },
            ..self
        }
    }

    /// The slots that have flat faces.
    #[must_use]
    pub fn flat_slots(&self) -> Vec<Joint> {
        if self.form.flat {
            self.structure.chain.flat_slots()
        } else {
            Vec::new()
        }
    }

    /// The same with flat faces, where it has slots that may have them.
    #[must_use]
    pub(crate) fn with_flat_faces(&self) -> Option<PairedStructure> {
        let flat = !self.structure.chain.flat_slots().is_empty();
        flat.then(|| PairedStructure {
            form: PairedForm { flat, ..self.form },
            ..self.clone()
        })
    }

    /// The same with a screw for a pinion whose racks are the jaws, guided in the frame as it is; `None` where that is not all.
    #[must_use]
    pub(crate) fn with_threads(&self) -> Option<PairedStructure> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let [base, screw] = self.drive();
        let is_nut = |&jaw: &usize| {
            chain.between(jaw, screw) == Some(PairKind::Gear)
                && chain.between(jaw, base) == Some(PairKind::Slide)
        };
        let all = chain.links() == 4 && base == roles.frame && roles.jaws.iter().all(is_nut);
        all.then(|| PairedStructure {
            form: PairedForm {
                threaded: true,
                ..PairedForm::of(Symmetry::Mirror)
            },
            ..self.clone()
        })
    }

    /// This, and the same with each jaw on a parallelogram, where it has one.
    pub(crate) fn with_parallelograms(self) -> impl Iterator<Item = PairedStructure> {
        let found = self.clone().on_parallelograms_if_any();
        let found = found.form.parallel.then_some(found);
        std::iter::once(self).chain(found)
    }
}

impl PairedStructure {
    /// Whether all joints are hinges but for a driver that slides in the frame, and no jaw is driven: laid out as a hinged structure.
    #[must_use]
    pub fn is_hinged(&self) -> bool {
        let roles = &self.structure.roles;
        let others = self.structure.chain.joints().into_iter();
        let mut others = others.filter(|j| j.pair != PairKind::Hinge);
        let apart = roles.is_driven_from_frame() && !roles.has_driven_jaw();
        apart && others.all(|j| j.links == roles.input)
    }
}
