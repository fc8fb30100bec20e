//! A mechanism as a structure, or why it is none.

use crate::chains::chain::MOST_LINKS;
use crate::chains::classics::MadeAs;
use crate::chains::structure::PairStructure;
use crate::geom::exact::ExactError;
use crate::model::LinkId;
use crate::model::mechanism::{Mechanism, Role};
use itertools::Itertools;
use thiserror::Error;

/// Why a mechanism is no structure of the catalogue's kind.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoStructure {
    /// Numbers without exact values.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// No joint turns, and none slides across another.
    #[error(
        "no joint turns and no two slide in different directions, so that there is no plane of motion"
    )]
    NoPlane,
    /// A joint that has no kind.
    #[error(
        "joint {joint:?} leaves {turns} turns and {slides} slides in the plane of motion; hinges, slides and pins in slots are known"
    )]
    Kind {
        /// The joint.
        joint: String,
        /// Turns.
        turns: usize,
        /// Slides.
        slides: usize,
    },
    /// Two joints between two links.
    #[error(
        "{0:?} and {1:?} are joined twice; chains have one pair between two links, or two pins in two slots"
    )]
    Twice(String, String),
    /// A coupling without a carrier.
    #[error("the coupling {0} joins no two links by a third that carries both")]
    Coupling(String),
    /// Not one drive.
    #[error("{0} joints are driven where one is to be: mark it with drive = true")]
    Drives(usize),
    /// A drive that is no hinge or slide.
    #[error("the driven joint is no hinge and no slide in the plane of motion")]
    DriveKind,
    /// A thread of another screw than those known.
    #[error(
        "joint {0:?} is a thread: of screws those are known that are driven in the frame and have two nuts, which slide along them as \
         jaws, with a right and a left thread of one lead"
    )]
    Thread(String),
    /// Neither two jaws nor three.
    #[error(
        "{0} links are outputs where two or three jaws are to be: mark them with role = \"output\""
    )]
    Jaws(usize),
    /// Links too few or too many.
    #[error(
        "links that move against each other in one plane: {0}; structures have 3 to {MOST_LINKS}"
    )]
    Links(usize),
}

/// A structure with the names that its links have in the mechanism.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recognized {
    /// The structure: of three sides that are alike that of two.
    pub structure: PairStructure,
    /// The structure with all its jaws.
    pub whole: PairStructure,
    /// The names of each link: several where they are one in the plane.
    pub names: Vec<Vec<String>>,
    /// What it is beside that: flat faces stand in it as slots where slides are between links that other slides join already.
    pub made_as: MadeAs,
}

impl Recognized {
    /// How many sides there are: 2; 3 that are alike, of which the structure has two; or 1, with three jaws that are no such sides.
    #[must_use]
    pub fn side_count(&self) -> usize {
        match self.structure.roles.jaws.len() {
            2 => self.whole.roles.jaws.len(),
            _ => 1,
        }
    }
}

/// The jaws, where there are two or three that are not the frame.
pub(super) fn jaw_links(
    m: &Mechanism,
    body: impl Fn(LinkId) -> Option<usize>,
) -> Result<Vec<usize>, NoStructure> {
    let outputs = m.links_with_ids().filter(|(_, l)| l.role == Role::Output);
    let jaws = outputs
        .filter_map(|(l, _)| body(l))
        .filter(|&l| body(m.frame_link()) != Some(l))
        .unique()
        .sorted()
        .collect_vec();
    match jaws.len() {
        2 | 3 => Ok(jaws),
        other => Err(NoStructure::Jaws(other)),
    }
}
