//! Instantaneous motions: the kernel of the closure matrix, the motions of links it gives, the faults of drives that they
//! show, and the working mobility,
//! that of the output links.

use crate::closure::drive::{rate_of_twist, rate_row};
use crate::closure::twist::MotionSpace;
use crate::closure::{Closure, Column};
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{self, Echelon};
use crate::linalg::modp::Residue;
use crate::model::joint_type::CoupledFreedom;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::rank::finite::Finite;

/// A motion of the whole mechanism: a speed for each column of J.
pub type Speeds = Vec<Residue>;

/// Returns the motions of a mechanism in its reference pose: a reduced basis of the kernel of J.
///
/// # Examples
/// ```
/// use ozols::{closure::Closure, model::mechanism::StateId, rank::exact::field::field_of};
/// use ozols::redundancy::motion::motion_basis;
/// let bennett = ozols::built_in("bennett")?;
/// let exact = field_of(&bennett, StateId::FREE, 0)?;
/// let motions = motion_basis(&exact, &Closure::new(&exact, &bennett, StateId::FREE)?);
/// assert_eq!((motions.len(), motions[0].len()), (1, 4)); // W = 1, a speed for each hinge.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn motion_basis(exact: &ExactField, closure: &Closure<Residue>) -> Vec<Speeds> {
    echelon::linear_relations(exact.field(), &closure.dense_columns(exact))
}

/// Returns the twist of a link under a motion.
#[must_use]
pub(crate) fn link_twist(
    exact: &ExactField,
    link_motion: &[Vec<Residue>],
    speeds: &[Residue],
) -> Vec<Residue> {
    echelon::linear_combination(exact.field(), link_motion, speeds)
}

/// Returns the twists of some links under a motion, one after the other.
pub(super) fn link_twists<'m>(
    exact: &ExactField,
    link_motions: impl IntoIterator<Item = &'m Vec<Vec<Residue>>>,
    speeds: &[Residue],
) -> Vec<Residue> {
    let each = link_motions.into_iter();
    each.flat_map(|m| link_twist(exact, m, speeds)).collect()
}

/// Returns the joint motion of some links and of the kept drives in a state. It is the reduced span of the links'
/// twists, one after the other, followed by the drives' rates. Locked drives are at rest.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
pub(crate) fn joint_motion(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
    links: &[LinkId],
) -> Result<Vec<Vec<Residue>>, ExactError> {
    let closure = Closure::new(exact, mechanism, state)?;
    let of_links = closure.link_motions(exact, mechanism, links);
    let of_drives = drive_rates(exact, mechanism, &closure)?;
    let mut columns = closure.dense_columns(exact);
    let mut kept: Vec<&Vec<Vec<Residue>>> = of_links.iter().collect();
    if mechanism.search.locks_drives {
        for (c, column) in columns.iter_mut().enumerate() {
            column.extend(of_drives.iter().map(|rates| rates[c][0]));
        }
    } else {
        kept.extend(&of_drives);
    }
    let motions = echelon::linear_relations(exact.field(), &columns);
    let moved = motions
        .iter()
        .map(|x| link_twists(exact, kept.iter().copied(), x));
    Ok(Echelon::from_vectors(exact.field(), moved).reduced_rows())
}

/// Returns, for each drive that the search follows, the rate that each column of J gives it, as a list of one number.
fn drive_rates(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Result<Vec<Vec<Vec<Residue>>>, ExactError> {
    let space = MotionSpace::new(exact, &mechanism.mode)?;
    let of_drive = |drive: &CoupledFreedom| {
        let at = &mechanism.joints[drive.joint].frame;
        let row = rate_row(exact, &space, mechanism, drive.joint, at)?.unwrap_or_default();
        let of_column = |c: &Column<Residue>| {
            let own = c.joint == drive.joint;
            vec![if own {
                rate_of_twist(exact, &row, &c.twist)
            } else {
                0
            }]
        };
        Ok(closure.columns.iter().map(of_column).collect())
    };
    mechanism.search.drives.iter().map(of_drive).collect()
}

/// Returns only the dimension of the output links' joint motion.
///
/// # Errors
/// Returns an error if a coordinate has no image in the field.
///
/// # Complexity
/// O(f³) field operations for f freedoms.
pub fn working_mobility(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
) -> Result<usize, ExactError> {
    let closure = Closure::new(exact, mechanism, state)?;
    let kernel = motion_basis(exact, &closure);
    let outputs = output_links(mechanism);
    Ok(span_of_links(exact, mechanism, &closure, &kernel, &outputs))
}

/// Returns the links whose motion is wanted.
pub(crate) fn output_links(mechanism: &Mechanism) -> Vec<LinkId> {
    mechanism
        .link_ids()
        .filter(|&l| mechanism.links[l].role == Role::Output)
        .collect()
}

/// Returns the dimension of the joint motion of some links over a basis of motions.
pub(crate) fn span_of_links(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
    links: &[LinkId],
) -> usize {
    let paths = closure.link_motions(exact, mechanism, links);
    let moved = kernel.iter().map(|x| link_twists(exact, &paths, x));
    Echelon::from_vectors(exact.field(), moved).rank()
}

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
    let of_drives = |x: &Speeds| -> Vec<Residue> { driven.iter().map(|d| x[d.0]).collect() };
    let speeds = Echelon::from_vectors(exact.field(), motions.iter().map(of_drives));
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
