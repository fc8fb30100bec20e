//! Faults of the drives of a mechanism: locked drives, drives that fight each other, and outputs at rest.

use crate::closure::Closure;
use crate::geom::exact::ExactField;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, Role, StateId};
use crate::rank::finite::Finite;
use crate::redundancy::motion::Speeds;

/// A fault of the drives of a state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DriveFault {
    /// Nothing moves, although there are drives.
    Immobile,
    /// There are more drives than the mechanism has degrees of freedom, so that they work against each other.
    Surplus {
        /// Number of drives.
        drives: usize,
        /// Upper bound of the number of degrees of freedom.
        mobility: usize,
    },
    /// The speeds of the drives that move depend on each other.
    Dependent {
        /// Number of drives that move.
        drives: usize,
        /// Number of independent speeds.
        independent: usize,
    },
    /// A drive cannot move in this pose.
    Locked(JointId),
    /// The outputs are at rest to first order while a drive moves.
    DeadPoint,
}

/// Returns the faults of the drives of the free state with these motions, J x = 0, of which the outputs have `working`
/// independent ones.
///
/// # Complexity
/// O(d² w) field operations for d drives and w motions.
pub(super) fn drive_faults(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    motions: &[Speeds],
    working: usize,
    finite: &Finite,
) -> Vec<DriveFault> {
    let driven = closure.columns.iter().enumerate().filter(|(_, c)| {
        let joint = &mechanism.joints[c.joint];
        joint.drive && joint.driven_freedom() == Some(c.freedom)
    });
    let driven: Vec<(usize, JointId)> = driven.map(|(i, c)| (i, c.joint)).collect();
    // If the part is clamped, a drive is intended to be locked.
    if driven.is_empty() || closure.state != StateId::FREE {
        return Vec::new();
    }
    let (drives, mobility) = (driven.len(), finite.at_most());
    if mobility == 0 {
        return vec![DriveFault::Immobile];
    }
    let moves = |&&(column, _): &&(usize, JointId)| motions.iter().any(|x| x[column] != 0);
    let moving = driven.iter().filter(moves).count();
    let mut speeds = Echelon::new(exact.field());
    for x in motions {
        let of_drives: Vec<Residue> = driven.iter().map(|&(column, _)| x[column]).collect();
        speeds.insert(&of_drives);
    }
    let mut out = Vec::new();
    if drives > mobility {
        out.push(DriveFault::Surplus { drives, mobility });
    } else if speeds.rank() < moving {
        out.push(DriveFault::Dependent {
            drives: moving,
            independent: speeds.rank(),
        });
    }
    let locked = driven.iter().filter(|one| !moves(one));
    out.extend(locked.map(|&(_, joint)| DriveFault::Locked(joint)));
    let has_outputs = mechanism.links.iter().any(|l| l.role == Role::Output);
    if has_outputs && working == 0 && moving > 0 {
        out.push(DriveFault::DeadPoint);
    }
    out
}
