//! The motion of a structure as a gripper when it is laid out, symmetrically or not.
//!
//! A symmetric graph is not enough. With pins in mirrored places the motion is often another, or the drive is dead.

use crate::chains::motion::{Swap, motions_in_way};
use crate::chains::roles::{Roles, Subject};
use crate::chains::{Input, Symmetry};
use itertools::Itertools;
use thiserror::Error;

/// Reason why a structure is not a gripper in nearly all places of a symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoGripper {
    /// No automorphism of the chain keeps frame and driver and swaps the jaws.
    #[error("nothing of the chain carries the jaws to each other")]
    Unsymmetric,
    /// More than one motion.
    #[error("{0} motions; exactly one is required")]
    Motions(usize),
    /// The drive cannot move.
    #[error("the drive cannot move")]
    DeadDrive,
    /// A jaw does not move.
    #[error("a jaw stands still")]
    DeadJaw,
    /// The jaws move as one body.
    #[error("the jaws do not move against each other")]
    Together,
}

/// Checks that a gripper laid out with the symmetry `swap` has one motion, in which the input moves, and the jaws move
/// against each other.
///
/// # Errors
/// Returns the reason if it does not.
///
/// # Complexity
/// An elimination of 3n columns.
fn check_motion(
    subject: &Subject<'_>,
    roles: &Roles,
    symmetry: Symmetry,
    input: Input,
    swap: &[usize],
) -> Result<(), NoGripper> {
    let chain = subject
        .chain
        .clone()
        .with_pair(roles.input, input.driven_pair());
    let swap = Swap {
        links: swap,
        image: symmetry,
    };
    let found = motions_in_way(&chain, swap, roles.frame, 0);
    let [motion] = &found[..] else {
        return Err(NoGripper::Motions(found.len()));
    };
    let rest = motion[roles.frame];
    let jaws = || roles.jaws.iter().map(|&l| motion[l]);
    if motion[roles.drive_links()[1]] == rest {
        Err(NoGripper::DeadDrive)
    } else if jaws().any(|j| j == rest) {
        Err(NoGripper::DeadJaw)
    } else if jaws().tuple_combinations().any(|(a, b)| a == b) {
        Err(NoGripper::Together)
    } else {
        Ok(())
    }
}

/// Returns the automorphism by which a structure moves as a gripper: the first that carries the jaws to each other, or the
/// identity for the generic case.
///
/// # Errors
/// Returns the reason why the last of them fails.
///
/// # Complexity
/// As of `check_motion`, for each automorphism.
pub fn working_swap(
    subject: &Subject<'_>,
    roles: &Roles,
    symmetry: Symmetry,
    input: Input,
) -> Result<Vec<usize>, NoGripper> {
    let identity: Vec<usize> = (0..subject.chain.links()).collect();
    let Some(jaws) = symmetry.jaw_count() else {
        return check_motion(subject, roles, symmetry, input, &identity).map(|()| identity);
    };
    let mut why = NoGripper::Unsymmetric;
    if roles.jaws.len() != jaws {
        return Err(why);
    }
    for swap in subject.iter_swaps(roles) {
        match check_motion(subject, roles, symmetry, input, swap) {
            Ok(()) => return Ok(swap.clone()),
            Err(e) => why = e,
        }
    }
    Err(why)
}
