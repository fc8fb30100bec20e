//! Result of recognition: a mechanism as a structure, or the reason why it has none.

use crate::chains::chain::MOST_LINKS;
use crate::chains::classics::MadeAs;
use crate::chains::structure::PairStructure;
use crate::geom::exact::ExactError;
use crate::model::LinkId;
use crate::model::mechanism::{Mechanism, Role};
use itertools::Itertools;
use thiserror::Error;

/// Why a mechanism has no structure of the kind in the catalogue.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoStructure {
    /// Some numbers have no exact values.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// No joint turns, and none slides across another.
    #[error(
        "no joint turns and no two slide in different directions, so that there is no plane of motion"
    )]
    NoPlane,
    /// A joint of unknown kind in the plane.
    #[error(
        "joint {joint:?} leaves {turns} turns and {slides} slides in the plane of motion; hinges, slides and pins in slots are known"
    )]
    Kind {
        /// The joint.
        joint: String,
        /// Number of turns in the plane.
        turns: usize,
        /// Number of slides in the plane.
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
    /// The number of driven joints is not one.
    #[error("{0} joints are driven where one is to be: mark it with drive = true")]
    Drives(usize),
    /// The driven joint is neither a hinge nor a slide.
    #[error("the driven joint is neither a hinge nor a slide in the plane of motion")]
    DriveKind,
    /// A thread of a screw of an unknown kind.
    #[error(
        "joint {0:?} is a thread: of screws those are known that are driven in the frame and have two nuts, which slide along them as \
         jaws, with a right and a left thread of one lead"
    )]
    Thread(String),
    /// The number of jaws is neither two nor three.
    #[error(
        "{0} links are outputs where two or three jaws are to be: mark them with role = \"output\""
    )]
    Jaws(usize),
    /// Too few or too many links.
    #[error(
        "links that move against each other in one plane: {0}; structures have 3 to {MOST_LINKS}"
    )]
    Links(usize),
}

/// A structure with the names that its links have in the mechanism.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recognized {
    /// The structure. For three equal sides, the structure of two of them.
    pub structure: PairStructure,
    /// The structure with all its jaws.
    pub whole: PairStructure,
    /// The names of each link; several if they are one link in the plane.
    pub names: Vec<Vec<String>>,
    /// Further properties. Flat faces count as slots if they are slides between links that other slides join already.
    pub made_as: MadeAs,
}

impl Recognized {
    /// Returns the number of sides: 2; 3 if they are equal, with the structure of two; or 1 for three jaws without such sides.
    #[must_use]
    pub fn side_count(&self) -> usize {
        match self.structure.roles.jaws.len() {
            2 => self.whole.roles.jaws.len(),
            _ => 1,
        }
    }
}

/// Returns the jaws if there are two or three besides the frame.
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
