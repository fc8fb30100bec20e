//! Whether a structure moves as a gripper when it is laid out, symmetrically or not.
//!
//! A symmetric graph is not enough: with pins in places that mirror each other the motion is often another, or the drive is
//! dead.

use crate::chains::pairs::chain::{PairChain, ordered};
use crate::chains::pairs::motion::{Image, Swap, generic_motions, motions_in_way};
use crate::chains::roles::{Roles, Subject};
use itertools::Itertools;
use thiserror::Error;

/// How a structure lies on itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Symmetry {
    /// Not at all: every pin where it likes.
    Generic,
    /// Across a line, along which the driver slides.
    Mirror,
    /// By half a turn about a centre, about which the driver turns.
    HalfTurn,
    /// By a third of a turn about a centre, about which the driver turns: three jaws.
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

    /// The word used for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        Symmetry::ALL[self as usize].1
    }

    /// Whether the input joint may move so: a mirror image needs a slide, half a turn or a third a hinge, since in the plane no
    /// slide is its own image then.
    #[must_use]
    pub fn suits(self, input: Input) -> bool {
        match self {
            Symmetry::Generic => true,
            Symmetry::Mirror => input == Input::Slide,
            Symmetry::HalfTurn | Symmetry::Threefold => input == Input::Turn,
        }
    }

    /// How many jaws it carries to each other, where it does.
    #[must_use]
    pub fn jaws(self) -> Option<usize> {
        match self {
            Symmetry::Generic => None,
            Symmetry::Mirror | Symmetry::HalfTurn => Some(2),
            Symmetry::Threefold => Some(3),
        }
    }
}

/// How the driver moves in the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Input {
    /// It slides.
    Slide,
    /// It turns.
    Turn,
}

impl Input {
    /// Every input with its word.
    pub const ALL: [(Input, &'static str); 2] = [(Input::Slide, "slide"), (Input::Turn, "turn")];

    /// The word used for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        Input::ALL[self as usize].1
    }
}

/// Why a structure is no gripper in nearly all places of a symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoGripper {
    /// No automorphism of the chain keeps frame and driver and carries the jaws to each other.
    #[error("nothing of the chain carries the jaws to each other")]
    Unsymmetric,
    /// More than one motion.
    #[error("{0} motions where there should be one")]
    Motions(usize),
    /// The drive cannot move.
    #[error("the drive cannot move")]
    DeadDrive,
    /// A jaw stands still.
    #[error("a jaw stands still")]
    DeadJaw,
    /// The jaws move as one body.
    #[error("the jaws do not move against each other")]
    Together,
}

/// Whether a gripper laid out so that `swap` is its symmetry has one motion, in which the input moves, and the jaws
/// against each other.
///
/// # Errors
/// What is wrong with it.
///
/// # Complexity
/// An elimination of 3n columns.
pub fn moves(
    subject: &Subject<'_>,
    roles: &Roles,
    symmetry: Symmetry,
    input: Input,
    swap: &[usize],
) -> Result<(), NoGripper> {
    let slide = (input == Input::Slide).then(|| ordered([roles.frame, roles.driver]));
    let chain = PairChain::hinged(subject.chain, slide);
    let placed = |image| {
        let swap = Swap { links: swap, image };
        motions_in_way(&chain, swap, roles.frame, 0)
    };
    let found = match symmetry {
        Symmetry::Generic => generic_motions(&chain),
        Symmetry::Mirror => placed(Image::Mirror),
        Symmetry::HalfTurn => placed(Image::HalfTurn),
        Symmetry::Threefold => placed(Image::ThirdTurn),
    };
    let [motion] = &found[..] else {
        return Err(NoGripper::Motions(found.len()));
    };
    let rest = motion[roles.frame];
    let jaws = || roles.jaws.iter().map(|&l| motion[l]);
    if motion[roles.driver] == rest {
        Err(NoGripper::DeadDrive)
    } else if jaws().any(|j| j == rest) {
        Err(NoGripper::DeadJaw)
    } else if jaws().tuple_combinations().any(|(a, b)| a == b) {
        Err(NoGripper::Together)
    } else {
        Ok(())
    }
}

/// The automorphism by which a structure moves as a gripper: the first of those that carry the jaws to each other, or the
/// identity where no symmetry is asked for.
///
/// # Errors
/// What is wrong with the last of them.
///
/// # Complexity
/// As [`moves`] for each.
pub fn working_swap(
    subject: &Subject<'_>,
    roles: &Roles,
    symmetry: Symmetry,
    input: Input,
) -> Result<Vec<usize>, NoGripper> {
    let identity: Vec<usize> = (0..subject.chain.links()).collect();
    let Some(jaws) = symmetry.jaws() else {
        return moves(subject, roles, symmetry, input, &identity).map(|()| identity);
    };
    let mut why = NoGripper::Unsymmetric;
    if roles.jaws.len() != jaws {
        return Err(why);
    }
    for swap in subject.swaps(roles) {
        match moves(subject, roles, symmetry, input, swap) {
            Ok(()) => return Ok(swap.clone()),
            Err(e) => why = e,
        }
    }
    Err(why)
}
