//! Reasons why there are no reactions.

use crate::geom::exact::ExactError;
use thiserror::Error;

/// Reason why there are no reactions.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Unsolved {
    /// The geometry has no numerical value.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The singular values did not converge.
    #[error("the singular values did not converge; check coordinates and loads for extreme values")]
    NoConvergence,
    /// The drives cannot move at their speeds.
    #[error(
        "the drives cannot go at the stated speeds in this pose, a dead point; state another workload.drive_speed, or look at \
         other poses with --stroke"
    )]
    Stuck,
    /// An inertia about a plane's normal is stated, but there is no plane.
    #[error(
        "link {link} states one number for its inertia, which is about the normal of a plane, and the mechanism moves in \
         space; give 3 about the axes or 6 of a tensor"
    )]
    PlaneInertia {
        /// The link.
        link: String,
    },
    /// The side of a face cannot be determined.
    #[error(
        "contact {joint} lies in one plane with all that touches {object}, so which way it pushes is open; give {object} a mass \
         and centre"
    )]
    Side {
        /// The contact.
        joint: String,
        /// The clamped part.
        object: String,
    },
    /// Contacts that only push cannot be in equilibrium.
    #[error(
        "no reactions are in equilibrium in which every contact pushes within its friction and its face: the object slips, \
         lifts off or tilts; drive the jaws harder, or state more friction or larger faces under [[workload.contact]]"
    )]
    Loose,
    /// The cone program has no solution.
    #[error("the programme of contacts that only push ended with {0}; no answer")]
    Programme(String),
    /// Loads do work on a motion that no drive holds.
    #[error(
        "no equilibrium: link {link} would move under the loads, and no drive holds it ({mobility} undriven freedoms); \
         mark a drive, take the load off, or give the joint less freedom"
    )]
    Moves {
        /// The link that would move fastest.
        link: String,
        /// Number of freedoms left with the drives locked.
        mobility: usize,
    },
}
