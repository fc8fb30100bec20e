//! Structures: a gripper's chain and roles with its symmetry, and its form.

pub mod listed;
pub(crate) mod threefold;

use crate::chains::chain::{Joint, carry_links, order_links};
use crate::chains::classics::MadeAs;
use crate::chains::layout_symmetry::{NoGripper, working_swap};
use crate::chains::motion::{Swap, symmetric_ways};
use crate::chains::roles::{Subject, carries_round};
use crate::chains::structure::PairStructure;
use crate::chains::{Input, PairKind, Symmetry, graph6};
use crate::synthesis::place::Place;
use crate::synthesis::task;
use crate::synthesis::task::Task;
use itertools::Itertools;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// The part of a gripper of two jaws that is repeated three times in a gripper of three jaws.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sides {
    /// The links of a side, that of the first jaw, by their numbers there.
    pub side: Vec<usize>,
    /// The links that are not repeated: the frame, the driver and others that the turn carries to themselves.
    pub own: Vec<usize>,
    /// The way in which the symmetry carries the gripper of two jaws to itself.
    pub(super) lay: Lay,
}

/// A gripper without places.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Structure {
    /// Chain and roles, in canonical numbering.
    pub structure: PairStructure,
    /// How it is laid out.
    pub form: Form,
    /// The part that is repeated three times, if the gripper has three jaws and is made of one with two.
    pub sides: Option<Sides>,
}

/// How a structure is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Form {
    /// Mirror image, half turn or generic.
    pub symmetry: Symmetry,
    /// Whether it has only hinges except for the input, a hinge or a slide along the x axis at the frame. Its name then begins with its
    /// graph.
    pub hinges: bool,
    /// Whether the symmetry carries the input joint elsewhere, so that it drives only one side.
    pub one_sided: bool,
    /// Whether each jaw is on a parallelogram, with the frame or with a driver that slides in it, so that it does not turn.
    pub parallel: bool,
    /// Whether slots between links that keep their attitude against each other have flat faces: slides, redundant in the plane already.
    pub flat: bool,
    /// Whether a pinion is a screw with a right and a left thread, and its racks are nuts.
    pub threaded: bool,
    /// Hinges that are on one pin with their mirror images, by the places of the first of both among the joints, as bits.
    pub one_pin: u32,
}

impl Form {
    /// Returns the form with a symmetry, driven on both sides, without parallelograms.
    ///
    /// # Examples
    /// ```
    /// use ozols::{chains::Symmetry, synthesis::structure::Form};
    /// let form = Form::of_symmetry(Symmetry::Mirror);
    /// assert!(form.suits_jaws(2) && !form.suits_jaws(3));
    /// ```
    #[must_use]
    pub fn of_symmetry(symmetry: Symmetry) -> Form {
        Form {
            symmetry,
            hinges: false,
            one_sided: false,
            parallel: false,
            flat: false,
            threaded: false,
            one_pin: 0,
        }
    }

    /// Returns every form of structures that have only hinges, each with its input, in order.
    pub fn of_hinges() -> impl Iterator<Item = (Input, Form)> {
        let inputs = Input::ALL.into_iter().map(|(input, _)| input);
        let symmetries = Symmetry::ALL.map(|(symmetry, _)| symmetry);
        let all = inputs.cartesian_product(symmetries);
        let all = all.filter(|(input, symmetry)| symmetry.suits_input(*input));
        let all = all.cartesian_product([false, true]);
        all.map(|((input, symmetry), parallel)| {
            let form = Form {
                parallel,
                hinges: true,
                ..Form::of_symmetry(symmetry)
            };
            (input, form)
        })
    }

    /// Returns whether a gripper of N jaws can be laid out in this form in a plane. Three jaws are never on parallelograms, which would
    /// take many links.
    #[must_use]
    pub fn suits_jaws(self, jaws: usize) -> bool {
        self.symmetry.jaw_count().is_none_or(|n| n == jaws) && (jaws == 2 || !self.parallel)
    }

    /// Returns whether a joint, the first of two, is on one pin with its image.
    #[must_use]
    pub(super) fn is_on_one_pin(self, joint: usize) -> bool {
        self.one_pin
            .checked_shr(joint as u32)
            .is_some_and(|rest| rest & 1 == 1)
    }

    /// Returns the form in words, the symmetry first.
    pub(super) fn name(self, symmetry: &str) -> String {
        let parallel = if self.parallel { " parallel" } else { "" };
        let flat = if self.flat { " flat" } else { "" };
        let threaded = if self.threaded { " threaded" } else { "" };
        format!("{symmetry}{parallel}{flat}{threaded}")
    }
}

/// A way in which the symmetry may carry a structure to itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lay {
    /// The image of each link under the symmetry.
    pub swap: Vec<usize>,
    /// A bit for each slide and slot that is its own mirror image, as [`crate::chains::motion::SymmetricWay`] has them.
    pub bits: u32,
}

impl Lay {
    /// Returns whether a joint may be on one pin with its image: a hinge between a link that the symmetry keeps and one that it moves.
    #[must_use]
    pub(super) fn may_share(&self, joint: &Joint) -> bool {
        let kept = joint.links.map(|l| self.swap[l] == l);
        joint.pair == PairKind::Hinge && kept[0] != kept[1]
    }
}

impl Structure {
    /// Returns a structure without repeated sides.
    #[must_use]
    pub fn new(structure: PairStructure, form: Form) -> Structure {
        Structure {
            structure,
            form,
            sides: None,
        }
    }

    /// Returns the full name. With only hinges, "E`ow 0-3 1,4 slide mirror" is the graph, frame and driver, jaws, input and form.
    #[must_use]
    pub fn name(&self) -> String {
        let form = self.form.name(&self.symmetry_name());
        if self.form.hinges {
            let PairStructure { chain, roles } = &self.structure;
            let [frame, driver] = roles.drive_links();
            let (jaws, input) = (roles.jaws.iter().join(","), self.drive_input().name());
            return format!(
                "{} {frame}-{driver} {jaws} {input} {form}",
                graph6::write_graph(chain)
            );
        }
        let pins = self.on_one_pin();
        let pins = pins.map(|j| format!(" pin{}-{}", j.links[0], j.links[1]));
        format!("{} {form}{}", self.structure.name(), pins.format(""))
    }

    /// Returns the symmetry in a word: "mirror", "mirror-but-input".
    #[must_use]
    pub(crate) fn symmetry_name(&self) -> String {
        let but = if self.form.one_sided {
            "-but-input"
        } else {
            ""
        };
        match self.sides {
            Some(_) => Symmetry::Threefold.name().to_owned(),
            None => format!("{}{but}", self.form.symmetry.name()),
        }
    }

    /// Returns the hinges that are on one pin with their images, the first of each two.
    fn on_one_pin(&self) -> impl Iterator<Item = Joint> {
        let joints = self.structure.chain.joints_made().into_iter();
        let shared = joints.enumerate();
        let shared = shared.filter(|(i, _)| self.form.is_on_one_pin(*i));
        shared.map(|(_, joint)| joint)
    }

    /// Returns the properties of the gripper that its chain and roles do not have.
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

    /// Returns the structure, and the structure with hinges on one pin with their mirror images, in every way in which no link has two
    /// such pins.
    ///
    /// # Complexity
    /// As [`Structure::symmetry_lays`].
    pub(crate) fn with_one_pins(self) -> impl Iterator<Item = Structure> {
        let joints = self.structure.chain.joints_made();
        let mirror = self.form.symmetry == Symmetry::Mirror;
        let lay = mirror
            .then(|| self.symmetry_lays().into_iter().next())
            .flatten();
        let first = |(i, joint): (usize, &Joint)| {
            let lay = lay.as_ref()?;
            let image = carry_links(joint.links, &lay.swap);
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
        ways.map(move |ways| Structure {
            form: Form {
                one_pin: ways.iter().fold(0, |bits, i| bits | 1 << i),
                ..self.form
            },
            ..self.clone()
        })
    }

    /// Returns a short name that needs no quoting in a shell: the number of links, and the beginning of the SHA-256 of the full name.
    #[must_use]
    pub fn id(&self) -> String {
        let mut id = format!("{}-", self.link_count());
        for byte in &Sha256::digest(self.name())[..6] {
            // Writing to a string does not fail.
            let _ = write!(id, "{byte:02x}");
        }
        id
    }

    /// Returns the places of the tips of the jaws as drawn for a task, in millimetres.
    #[must_use]
    pub fn tip_places(&self, task: &Task) -> Vec<Place> {
        task::draw_tips(self.structure.roles.jaws.len(), self.form.symmetry, task)
    }

    /// Returns how the structure is driven.
    #[must_use]
    pub fn drive_input(&self) -> Input {
        if self.structure.input_slides() {
            Input::Slide
        } else {
            Input::Turn
        }
    }

    /// Returns the ways in which the symmetry may carry the structure to itself while it moves as a gripper.
    ///
    /// # Complexity
    /// An elimination for each way of each automorphism.
    #[must_use]
    pub fn symmetry_lays(&self) -> Vec<Lay> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        if self.form.symmetry == Symmetry::Generic {
            let identity = (0..chain.links()).collect();
            return self.moving_lays([identity]).collect();
        }
        // Grippers of three jaws are made of grippers of two.
        if roles.jaws.len() != 2 {
            return Vec::new();
        }
        let involutions = chain.automorphisms().into_iter().filter(|s| {
            let keeps = carry_links(roles.input, s) == roles.input;
            let fixed = s[roles.frame] == roles.frame && keeps != self.form.one_sided;
            fixed && carries_round(&roles.jaws, s)
        });
        if self.form.threaded {
            // A screw turns as its mirror image does, so that nuts of a right and a left thread are each other's image.
            let lay = |swap| Lay { swap, bits: 0 };
            return involutions.map(lay).collect();
        }
        self.moving_lays(involutions).collect()
    }

    fn moving_lays(
        &self,
        swaps: impl IntoIterator<Item = Vec<usize>>,
    ) -> impl Iterator<Item = Lay> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let of = move |swap: Vec<usize>| {
            let symmetry = Swap {
                links: &swap,
                image: self.form.symmetry,
            };
            let ways = symmetric_ways(chain, symmetry, roles.frame).into_iter();
            let moving = ways.filter(|w| roles.moves_in(&w.motion));
            let lay = moving.map(|w| Lay {
                swap: swap.clone(),
                bits: w.bits,
            });
            lay.collect_vec()
        };
        swaps.into_iter().flat_map(of)
    }

    /// Returns the first of [`Structure::symmetry_lays`] for a structure of hinges.
    ///
    /// # Errors
    /// Returns an error if there is no such way.
    ///
    /// # Complexity
    /// A canonical numbering, and an elimination for each automorphism.
    pub fn hinged_lay(&self) -> Result<Lay, NoGripper> {
        let roles = &self.structure.roles;
        let hinges = self
            .structure
            .chain
            .clone()
            .with_pair(roles.input, PairKind::Hinge);
        let (chain, mut automorphisms) = hinges.canonical_form();
        if chain != hinges {
            automorphisms = hinges.automorphisms();
        }
        let subject = Subject::new(&hinges, &automorphisms);
        let swap = working_swap(&subject, roles, self.form.symmetry, self.drive_input())?;
        Ok(Lay { swap, bits: 0 })
    }

    /// Returns the joints of a parallelogram for each jaw, or `None` if a jaw has none. The joints of two rods at the base come first, then
    /// those at the jaw in the same order.
    #[must_use]
    pub fn parallelogram_rings(&self) -> Option<Vec<[[usize; 2]; 4]>> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let [base, driver] = roles.drive_links();
        let sliding = (base == roles.frame && self.structure.input_slides()).then_some(driver);
        let hinged = |u: usize, v: usize| chain.pair_between(u, v) == Some(PairKind::Hinge);
        let ring = |jaw: usize| {
            let bases = std::iter::once(roles.frame).chain(sliding);
            bases.filter(|b| *b != jaw).find_map(|base| {
                let rod =
                    |l: &usize| hinged(*l, jaw) && hinged(*l, base) && !roles.jaws.contains(l);
                let (p, q) = (0..chain.links()).filter(rod).tuples().next()?;
                Some([[p, base], [q, base], [p, jaw], [q, jaw]].map(order_links))
            })
        };
        roles.jaws.iter().map(|&jaw| ring(jaw)).collect()
    }

    /// Returns whether there is an automorphism that keeps frame and input joint and carries each jaw to the next: one of
    /// [`Subject::iter_swaps`].
    #[must_use]
    pub fn is_graph_symmetric(&self) -> bool {
        let chain = &self.structure.chain;
        let automorphisms = chain.automorphisms();
        let subject = Subject::new(chain, &automorphisms);
        self.sides.is_some() || subject.is_graph_symmetric(&self.structure.roles)
    }

    pub(super) fn on_parallelograms_if_any(self) -> Structure {
        let parallel = self.parallelogram_rings().is_some();
        Structure {
            form: Form {
                parallel,
                ..self.form
            },
            ..self
        }
    }

    /// Returns the slots that have flat faces.
    #[must_use]
    pub fn flat_slots(&self) -> Vec<Joint> {
        if self.form.flat {
            self.structure.chain.flat_slots()
        } else {
            Vec::new()
        }
    }

    /// Returns the structure with flat faces, if it has slots that may have them.
    #[must_use]
    pub(crate) fn with_flat_faces(&self) -> Option<Structure> {
        let flat = !self.structure.chain.flat_slots().is_empty();
        flat.then(|| Structure {
            form: Form { flat, ..self.form },
            ..self.clone()
        })
    }

    /// Returns the structure with a screw and nuts instead of a pinion and racks. `None` unless it consists of a frame, a pinion and two
    /// jaws that are racks and slide in the frame.
    #[must_use]
    pub(crate) fn with_threads(&self) -> Option<Structure> {
        let (chain, roles) = (&self.structure.chain, &self.structure.roles);
        let [base, screw] = roles.drive_links();
        let is_nut = |&jaw: &usize| {
            chain.pair_between(jaw, screw) == Some(PairKind::Gear)
                && chain.pair_between(jaw, base) == Some(PairKind::Slide)
        };
        let all = chain.links() == 4 && base == roles.frame && roles.jaws.iter().all(is_nut);
        all.then(|| Structure {
            form: Form {
                threaded: true,
                ..Form::of_symmetry(Symmetry::Mirror)
            },
            ..self.clone()
        })
    }

    /// Returns the structure, and the structure with each jaw on a parallelogram if each jaw has one.
    pub(crate) fn with_parallelograms(self) -> impl Iterator<Item = Structure> {
        let found = self.clone().on_parallelograms_if_any();
        let found = found.form.parallel.then_some(found);
        std::iter::once(self).chain(found)
    }

    /// Returns whether all joints are hinges except for the joint of a driver in the frame, and no jaw is driven.
    #[must_use]
    pub fn is_hinged(&self) -> bool {
        let roles = &self.structure.roles;
        let others = self.structure.chain.joints().into_iter();
        let mut others = others.filter(|j| j.pair != PairKind::Hinge);
        let apart = roles.is_driven_from_frame() && !roles.has_driven_jaw();
        apart && others.all(|j| j.links == roles.input)
    }
}
