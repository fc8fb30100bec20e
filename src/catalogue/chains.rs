//! Kinematic chains: the links and the kinds of joints between them, without places; and the grippers that they make.
//!
//! A [`PairKind`] leaves one freedom (hinge, slide) or two (gear pair or rack; pin in a slot, cam, wedge). A planar chain of n links
//! therefore has the mobility W = 3(n - 1) - 2(R + P) - (G + S). A chain of hinges only has no rigid part if every part of two links
//! or more has a mobility of at least 1. Any other chain counts if, in nearly all places of its joints, its mobility is 1
//! and every two links move against each other. For hinges and pairs of two freedoms, a count of every part decides
//! this. With slides the rank decides it (loops of slides only, hinges locked by slides), see [`motion`].
//! If chains differ only in numbering, one of them is listed.
//!
//! Conventions: two links have at most one pair, and every link has two or more. No hinge joins three links. A gear pair needs
//! a carrier: a link that is hinged to both gears, or that is hinged to the pinion and slides on the rack. The input is a hinge or a
//! slide, at the frame or between two moving links. A jaw is never the frame; it is *driven* if it is a link of the input joint.

pub mod canonical;
pub mod census;
pub mod chain;
pub mod classics;
pub mod enumerate;
pub mod graph6;
pub mod layout_symmetry;
pub mod motion;
pub mod roles;
pub mod sharing;
pub mod structure;
pub mod symmetric_census;
pub mod visit;

use serde::{Deserialize, Serialize};

/// A pair of links in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PairKind {
    /// They turn about a pin.
    Hinge = 1,
    /// One slides along the other.
    Slide,
    /// Teeth: two gears, or a rack and its pinion. They roll, but the teeth do not keep their centres at a distance.
    Gear,
    /// A pin in a slot, a cam and its follower, a wedge: they touch along a line of action.
    Slot,
    /// Two pins in two slots: they turn about the intersection of the lines of action, which moves with them.
    TwoSlots,
}

impl PairKind {
    /// Every kind with the word and the letter it has in codes.
    pub const ALL: [(PairKind, &'static str, char); 5] = [
        (PairKind::Hinge, "hinge", 'R'),
        (PairKind::Slide, "slide", 'P'),
        (PairKind::Gear, "gear", 'G'),
        (PairKind::Slot, "slot", 'S'),
        (PairKind::TwoSlots, "two-slots", 'D'),
    ];

    /// Returns the word for the kind.
    #[must_use]
    pub fn name(self) -> &'static str {
        PairKind::ALL[self as usize - 1].1
    }

    /// Returns the letter of the kind in codes.
    #[must_use]
    pub fn code_letter(self) -> char {
        PairKind::ALL[self as usize - 1].2
    }

    /// Returns the kind that a letter names in codes.
    #[must_use]
    pub(crate) fn of_letter(letter: char) -> Option<PairKind> {
        let found = PairKind::ALL.iter().find(|kind| kind.2 == letter);
        found.map(|kind| kind.0)
    }

    /// Returns the kind that the weight of an edge represents; `None` if there is no edge.
    #[must_use]
    pub(crate) fn of_weight(weight: u8) -> Option<PairKind> {
        let at = usize::from(weight).checked_sub(1)?;
        PairKind::ALL.get(at).map(|kind| kind.0)
    }

    /// Returns whether the pair is a hinge or a slide, which may be driven or carry gears.
    #[must_use]
    pub(crate) fn is_lower(self) -> bool {
        matches!(self, PairKind::Hinge | PairKind::Slide)
    }

    /// Returns whether the pair leaves two freedoms; the others leave one.
    #[must_use]
    pub(crate) fn leaves_two(self) -> bool {
        matches!(self, PairKind::Gear | PairKind::Slot)
    }
}

/// The symmetry of a structure and its layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Symmetry {
    /// No symmetry: the place of every pin is free.
    Generic,
    /// A mirror image across a line, along which the driver slides.
    Mirror,
    /// Half a turn about a centre, about which the driver turns.
    HalfTurn,
    /// A third of a turn about a centre, about which the driver turns: three jaws.
    Threefold,
}

impl Symmetry {
    /// Every symmetry with its word.
    pub const ALL: [(Symmetry, &'static str); 4] = [
        (Symmetry::Generic, "generic"),
        (Symmetry::Mirror, "mirror"),
        (Symmetry::HalfTurn, "half-turn"),
        (Symmetry::Threefold, "threefold"),
    ];

    /// Returns the word for the symmetry.
    #[must_use]
    pub fn name(self) -> &'static str {
        Symmetry::ALL[self as usize].1
    }

    /// Returns whether the symmetry can carry the input joint to itself. A mirror image needs a slide. Half a turn and a third of a
    /// turn need a hinge, since they carry no slide in the plane to itself.
    #[must_use]
    pub fn suits_input(self, input: Input) -> bool {
        match self {
            Symmetry::Generic => true,
            Symmetry::Mirror => input == Input::Slide,
            Symmetry::HalfTurn | Symmetry::Threefold => input == Input::Turn,
        }
    }

    /// Returns the number of jaws that the symmetry carries to each other; `None` for the generic case.
    #[must_use]
    pub fn jaw_count(self) -> Option<usize> {
        match self {
            Symmetry::Generic => None,
            Symmetry::Mirror | Symmetry::HalfTurn => Some(2),
            Symmetry::Threefold => Some(3),
        }
    }
}

/// Motion of the driver in the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Input {
    /// It slides.
    Slide,
    /// It turns.
    Turn,
}

impl Input {
    /// Every input with its word.
    pub const ALL: [(Input, &'static str); 2] = [(Input::Slide, "slide"), (Input::Turn, "turn")];

    /// Returns the word for the input.
    #[must_use]
    pub fn name(self) -> &'static str {
        Input::ALL[self as usize].1
    }

    /// Returns the kind of the driven joint.
    #[must_use]
    pub(crate) fn driven_pair(self) -> PairKind {
        match self {
            Input::Slide => PairKind::Slide,
            Input::Turn => PairKind::Hinge,
        }
    }
}
