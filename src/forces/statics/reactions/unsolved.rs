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
        "the drives cannot move at the given speeds in this pose, a dead point; give another \
        workload.drive_speed, or analyse other poses"
    )]
    Stuck,
    /// An inertia about a plane's normal is stated, but there is no plane.
    #[error(
        "link {link} has one number for its inertia, about the normal of a plane, but the \
        mechanism moves in space; give 3 about the axes or 6 of a tensor"
    )]
    PlaneInertia {
        /// The link.
        link: String,
    },
    /// The side of a face cannot be determined.
    #[error(
        "contact {joint} lies in one plane with everything that touches {object}, so the \
        direction of its push is undetermined; give {object} a mass and centre"
    )]
    Side {
        /// The contact.
        joint: String,
        /// The clamped part.
        object: String,
    },
    /// Contacts that only push cannot be in equilibrium.
    #[error(
        "no reactions are in equilibrium in which every contact pushes within its friction and \
        its face; the clamped part slips, lifts off or tilts; drive the jaws harder, or give more \
        friction or larger faces under [[workload.contact]]"
    )]
    Loose,
    /// The cone program has no solution.
    #[error("the cone program for the unilateral contacts stopped with {0}; no result")]
    Programme(String),
    /// Loads do work on a motion that no drive holds.
    #[error(
        "no equilibrium: link {link} would move under the loads, and no drive holds it \
        ({mobility} undriven freedoms); mark a drive, remove the load, or give the joint less \
        freedom"
    )]
    Moves {
        /// The link that would move fastest.
        link: String,
        /// Number of freedoms left with the drives locked.
        mobility: usize,
    },
}
