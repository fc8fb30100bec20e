//! How many chains there are, and in how many ways their links make grippers.

use crate::chains::chain::Chain;
use crate::chains::enumerate::{ChainsError, visit_chains};
use crate::chains::layout_symmetry::working_swap;
use crate::chains::roles::{Roles, Subject};
use crate::chains::sharing::Menu;
use crate::chains::visit::visit_pair_chains;
use crate::chains::{Input, PairKind, Symmetry};
use std::collections::BTreeMap;
use std::ops::{AddAssign, Index};
use std::sync::{Mutex, PoisonError};

/// The numbers of pairs of a chain, for each kind other than hinges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Kinds {
    /// Slides.
    pub slides: usize,
    /// Gear pairs and racks.
    pub gears: usize,
    /// Slots, cams and wedges.
    pub slots: usize,
    /// Two slots between the same links.
    pub two_slots: usize,
}

impl Kinds {
    /// Returns the numbers of pairs of a chain.
    #[must_use]
    pub fn of_chain(chain: &Chain) -> Kinds {
        Kinds {
            slides: chain.count_pairs(PairKind::Slide),
            gears: chain.count_pairs(PairKind::Gear),
            slots: chain.count_pairs(PairKind::Slot),
            two_slots: chain.count_pairs(PairKind::TwoSlots),
        }
    }

    /// Returns the number of slots, two slots between the same links counted as two.
    #[must_use]
    pub fn slots_made(self) -> usize {
        self.slots + 2 * self.two_slots
    }

    /// Returns the numbers when the given number of slots have flat faces, which are slides.
    #[must_use]
    pub fn with_flat(self, flat: usize) -> Kinds {
        Kinds {
            slides: self.slides + flat,
            slots: self.slots - flat,
            ..self
        }
    }
}

/// A property by which grippers are counted. Each but the first is counted of essential grippers only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counted {
    /// All.
    All,
    /// Those of which no smaller moving part holds all roles.
    Essential,
    /// No jaw is joined to the frame.
    Floating,
    /// One jaw is joined to the frame.
    OneAtFrame,
    /// Both jaws are joined to the frame.
    BothAtFrame,
    /// They make a truss with a part hinged to both jaws.
    Truss,
    /// All jaws keep their attitude.
    Translating,
    /// An automorphism keeps frame and input joint, and swaps two jaws or carries three around.
    GraphSymmetric,
    /// They move symmetrically in places that mirror each other. Grippers of hinges are counted with a slide as their input.
    Mirror,
    /// The same without the demand on the input joint.
    MirrorButInput,
    /// They move symmetrically in places that half a turn carries to each other.
    HalfTurn,
    /// The same without the demand on the input joint.
    HalfTurnButInput,
    /// They move symmetrically in places that a third of a turn carries to each other.
    Threefold,
}

/// Counts of choices of jaws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Grippers([u64; 13]);

impl Index<Counted> for Grippers {
    type Output = u64;

    fn index(&self, of: Counted) -> &u64 {
        &self.0[of as usize]
    }
}

impl AddAssign for Grippers {
    fn add_assign(&mut self, o: Grippers) {
        self.0.iter_mut().zip(o.0).for_each(|(a, b)| *a += b);
    }
}

impl Grippers {
    fn count_if(&mut self, of: Counted, holds: bool) {
        self.0[of as usize] += u64::from(holds);
    }

    /// Adds a gripper to the counts of all and of essential ones. Returns whether it is essential: other counts are of essential ones.
    fn take_essential(&mut self, subject: &Subject<'_>, roles: &Roles) -> bool {
        let essential = subject.is_essential(roles);
        self.count_if(Counted::All, true);
        self.count_if(Counted::Essential, essential);
        essential
    }

    /// Adds a gripper that has only hinges and is driven from the frame.
    fn take_hinged(&mut self, subject: &Subject<'_>, roles: &Roles) {
        if !self.take_essential(subject, roles) {
            return;
        }
        let at_frame = [Counted::Floating, Counted::OneAtFrame, Counted::BothAtFrame];
        if let Some(&at_frame) = at_frame.get(subject.jaws_at_frame(roles)) {
            self.count_if(at_frame, true);
        }
        self.count_if(Counted::Truss, subject.is_truss(roles));
        if subject.is_graph_symmetric(roles) {
            self.count_if(Counted::GraphSymmetric, true);
            let works = |symmetry, input| working_swap(subject, roles, symmetry, input).is_ok();
            self.count_if(Counted::Mirror, works(Symmetry::Mirror, Input::Slide));
            self.count_if(Counted::HalfTurn, works(Symmetry::HalfTurn, Input::Turn));
            self.count_if(Counted::Threefold, works(Symmetry::Threefold, Input::Turn));
        }
    }

    /// Adds a gripper of any pairs.
    fn take_paired(&mut self, subject: &Subject<'_>, roles: &Roles) {
        if !self.take_essential(subject, roles) {
            return;
        }
        let s = subject.find_symmetries(roles);
        self.count_if(Counted::Translating, subject.is_translating(roles));
        self.count_if(Counted::GraphSymmetric, s.graph);
        self.count_if(Counted::Mirror, s.mirror);
        self.count_if(Counted::MirrorButInput, s.mirror_but_input);
        self.count_if(Counted::HalfTurn, s.half_turn);
        self.count_if(Counted::HalfTurnButInput, s.half_turn_but_input);
    }
}

/// The way in which a gripper is driven: its number of jaws, the place and kind of its input joint, and whether a jaw is driven.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DriveKind {
    /// Jaws.
    pub jaws: usize,
    /// Between two moving links; otherwise at the frame.
    pub between: bool,
    /// A jaw is a link of it; otherwise the jaws are apart.
    pub jaw: bool,
    /// It slides; otherwise it turns.
    pub slides: bool,
}

impl DriveKind {
    /// Returns the drive of grippers that have hinges only: a hinge at the frame, apart from the given number of jaws.
    #[must_use]
    pub fn of_hinges(jaws: usize) -> DriveKind {
        DriveKind {
            jaws,
            between: false,
            jaw: false,
            slides: false,
        }
    }
}

/// Counts of the chains of some links and kinds, everything up to automorphism.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Census {
    /// Chains.
    pub chains: u64,
    /// Choices of a frame.
    pub frames: u64,
    /// Choices of an input joint, without a frame.
    pub inputs: u64,
    /// Choices of a frame and an input joint at it.
    pub inputs_at_frame: u64,
    /// Choices of a frame and an input joint between two other links.
    pub inputs_between: u64,
    /// Choices of jaws with a frame and an input joint.
    pub grippers: BTreeMap<DriveKind, Grippers>,
}

impl AddAssign for Census {
    fn add_assign(&mut self, o: Census) {
        self.chains += o.chains;
        self.frames += o.frames;
        self.inputs += o.inputs;
        self.inputs_at_frame += o.inputs_at_frame;
        self.inputs_between += o.inputs_between;
        for (drive, counts) in o.grippers {
            *self.grippers.entry(drive).or_default() += counts;
        }
    }
}

impl Census {
    fn of_choices(subject: &Subject<'_>) -> Census {
        let (between, at_frame): (Vec<_>, Vec<_>) =
            (subject.list_drives().into_iter()).partition(|(frame, input)| !input.is_at(*frame));
        Census {
            chains: 1,
            frames: subject.count_frames() as u64,
            inputs: subject.iter_inputs().count() as u64,
            inputs_at_frame: at_frame.len() as u64,
            inputs_between: between.len() as u64,
            grippers: BTreeMap::new(),
        }
    }

    /// Returns the counts of one chain that has hinges only. Its grippers have two or three jaws, apart from a driver at the frame.
    ///
    /// # Complexity
    /// A step for each choice of roles, and an elimination for each symmetric one.
    #[must_use]
    pub fn of_hinges(subject: &Subject<'_>, grippers: bool) -> Census {
        let mut out = Census::of_choices(subject);
        for jaws in (2..=3).filter(|_| grippers) {
            let counts = out.grippers.entry(DriveKind::of_hinges(jaws)).or_default();
            let all = subject.grippers_apart(jaws);
            all.for_each(|roles| counts.take_hinged(subject, &roles));
        }
        out
    }

    /// Returns the counts of one chain of any pairs. Its grippers have two jaws.
    ///
    /// # Complexity
    /// A step for each choice of roles and each smaller moving part.
    #[must_use]
    pub fn of_pairs(subject: &Subject<'_>, grippers: bool) -> Census {
        let mut out = Census::of_choices(subject);
        for (frame, input) in subject.list_drives().into_iter().filter(|_| grippers) {
            for roles in subject.list_grippers(frame, &input, 2) {
                let drive = DriveKind {
                    jaws: 2,
                    between: !input.is_at(frame),
                    jaw: roles.has_driven_jaw(),
                    slides: input.pair == PairKind::Slide,
                };
                let counts = out.grippers.entry(drive).or_default();
                counts.take_paired(subject, &roles);
            }
        }
        out
    }
}

/// Returns the counts over all chains of hinges with N links and this mobility. Grippers are counted if the mobility is 1.
///
/// # Errors
/// Returns an error in the same cases as [`visit_chains`].
///
/// # Examples
/// ```
/// use ozols::chains::census::{Counted, DriveKind, count_hinged};
/// let of_six = count_hinged(6, 1, true)?;
/// let two_jaws = &of_six.grippers[&DriveKind::of_hinges(2)];
/// assert_eq!((two_jaws[Counted::All], two_jaws[Counted::Essential]), (46, 40));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn count_hinged(links: usize, mobility: usize, grippers: bool) -> Result<Census, ChainsError> {
    let all = Mutex::new(Census::default());
    visit_chains(links, mobility, &|chain| {
        let (chain, automorphisms) = chain.canonical_form();
        let subject = Subject::new(&chain, &automorphisms);
        let one = Census::of_hinges(&subject, grippers && mobility == 1);
        *all.lock().unwrap_or_else(PoisonError::into_inner) += one;
    })?;
    Ok(all.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Returns the counts over all chains of N links, by the numbers of their pairs of each kind.
///
/// # Complexity
/// As [`visit_pair_chains`].
#[must_use]
pub fn pair_census(links: usize, menu: Menu<'_>, grippers: bool) -> BTreeMap<Kinds, Census> {
    let all = Mutex::new(BTreeMap::<Kinds, Census>::new());
    visit_pair_chains(links, menu, &|subject| {
        let (kinds, one) = (
            Kinds::of_chain(subject.chain),
            Census::of_pairs(subject, grippers),
        );
        let mut all = all.lock().unwrap_or_else(PoisonError::into_inner);
        *all.entry(kinds).or_default() += one;
    });
    all.into_inner().unwrap_or_else(PoisonError::into_inner)
}
