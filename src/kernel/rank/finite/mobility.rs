//! A finite mobility with the evidence for it, and its proof by ranks and groups.
//!
//! A freedom with speed 0 in every instantaneous motion takes no part in any of them. If it is locked, the null space
//! of J is as large as before. A proven motion of the locked mechanism is also a motion of the whole mechanism, and no
//! motion exceeds the instantaneous mobility. So the finite mobility of a pose is proven if it is that of the mechanism
//! with such freedoms locked. An example is the spatial slider of a planar linkage that could turn about its guide, but
//! does not.

use crate::geom::exact::ExactError;
use crate::linalg::echelon::{Echelon, transpose};
use crate::linalg::modp::Residue;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, Mechanism};
use crate::rank::exact::modular::ExactState;
use crate::rank::finite::bonds;
use crate::rank::finite::displacement_group::group_dimension;
use itertools::Itertools;

/// Proof that a pose is a regular one of its motion. If several apply, the one with the most conditions comes last.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Proof {
    /// J has the full rank of the groups its contours move in and of its couplings.
    Groups,
    /// J has that rank with the freedoms locked that are at rest to first order.
    Resting,
    /// Chains and legs reduce to single joints, [`crate::rank::finite::bonds`].
    Bonds,
    /// No motion is stopped up to the highest order that could stop it.
    Multiplicity,
    /// Each contour on its own is proven regular, and the ranks of the contours add up.
    Contours,
}

/// Evidence for a finite mobility, in the order of what it leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum How {
    /// Nothing moves even instantaneously.
    Rigid,
    /// The motion is a manifold of all that moves instantaneously: the pose is a regular one. Proven.
    Submersion {
        /// The proof.
        by: Proof,
        /// The required rank.
        dimension: usize,
    },
    /// Instantaneous motions are stopped by second or higher order: a shaky pose. Proven.
    Stopped {
        /// The order that stops the last of them.
        order: usize,
        /// Number of instantaneous motions that are not finite.
        motions: usize,
    },
    /// Motions of this dimension, and none of a larger one, pass through a singular pose. Proven.
    Singular {
        /// The order that decides it.
        order: usize,
    },
    /// Followed by Newton's method; numeric.
    Traced {
        /// Number of poses closed.
        poses: usize,
        /// Whether the pose of the file is a regular one of its motion.
        regular: bool,
    },
    /// Not followed, because the mechanism is too large: at most the instantaneous mobility.
    Bound,
    /// Neither proof nor numerical following decides.
    Undecided,
    /// Coordinates are rounded too coarsely to distinguish a motion from a shaky pose, or to determine the rank of J.
    Rounded,
}

impl Proof {
    /// Explains why a pose is regular, whose J has rank `dimension`.
    fn why_regular(self, dimension: usize) -> String {
        match self {
            Proof::Groups => {
                format!("J has the full rank {dimension} of the displacement groups of its loops")
            }
            Proof::Resting => format!(
                "with the resting joints locked, J has the full rank {dimension} of the displacement groups of its loops"
            ),
            Proof::Bonds => "chains of joints generate whole displacement groups".to_owned(),
            Proof::Multiplicity => {
                "no obstruction exists up to the highest order at which one could occur".to_owned()
            }
            Proof::Contours => {
                "each loop keeps its first-order motion, and no loop repeats constraints of others"
                    .to_owned()
            }
        }
    }
}

/// The finite mobility of a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Finite {
    /// Dimension of the motion. If undecided, its lower bound: the motion that certainly exists.
    pub mobility: usize,
    /// Upper bound of the dimension.
    most: usize,
    /// The evidence.
    pub how: How,
    /// Whether the rank of J that it is based on is numeric.
    pub numeric: bool,
}

impl Finite {
    pub(super) fn new(mobility: usize, how: How) -> Finite {
        Finite::between(mobility, mobility, how)
    }

    /// Creates the result for a dimension within bounds.
    pub(crate) fn between(mobility: usize, most: usize, how: How) -> Finite {
        Finite {
            mobility,
            most,
            how,
            numeric: false,
        }
    }

    /// Creates the proven result for a regular pose whose J has rank `dimension`.
    pub(super) fn regular_pose(mobility: usize, dimension: usize, by: Proof) -> Finite {
        Finite::new(mobility, How::Submersion { dimension, by })
    }

    /// Returns true if the mobility is a range.
    #[must_use]
    pub fn is_undecided(&self) -> bool {
        self.most > self.mobility
    }

    /// Returns the same mobility, based on a numeric rank.
    #[must_use]
    pub(crate) fn by_numeric_rank(self) -> Finite {
        Finite {
            numeric: true,
            ..self
        }
    }

    /// Returns true if it follows from exact arithmetic only.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        !self.numeric
            && matches!(
                self.how,
                How::Rigid | How::Submersion { .. } | How::Stopped { .. } | How::Singular { .. }
            )
    }

    /// Returns the upper bound.
    #[must_use]
    pub fn at_most(&self) -> usize {
        self.most
    }

    /// Returns true if the mobility can have this value.
    #[must_use]
    pub fn could_be(&self, mobility: i64) -> bool {
        let least = i64::try_from(self.mobility).unwrap_or(i64::MAX);
        let most = i64::try_from(self.at_most()).unwrap_or(i64::MAX);
        (least..=most).contains(&mobility)
    }

    /// Returns the figure for display: a number, or a range if undecided.
    #[must_use]
    pub fn format_figure(&self) -> String {
        match self.at_most() {
            most if most > self.mobility => format!("{} to {most}", self.mobility),
            mobility => mobility.to_string(),
        }
    }

    /// Describes the result in one line for display.
    #[must_use]
    pub fn describe(&self) -> String {
        let line = match self.how {
            How::Rigid if self.mobility > 0 => {
                "joints outside loops move freely, and so do links that all their joints leave a \
                common freedom; nothing else moves, not even instantaneously"
                    .to_owned()
            }
            How::Rigid => "nothing moves, not even instantaneously".to_owned(),
            How::Submersion { dimension, by } => {
                format!("{}, so this pose is regular", by.why_regular(dimension))
            }
            How::Stopped { order, motions } => {
                let what = match (motions, motions + self.mobility) {
                    (1, 1) => "the one instantaneous motion is".to_owned(),
                    (n, all) if n == all => format!("all {n} instantaneous freedoms are"),
                    (1, all) => format!("1 of {all} instantaneous freedoms is"),
                    (n, all) => format!("{n} of {all} instantaneous freedoms are"),
                };
                format!("{what} stopped by {} (a shaky pose)", in_words(order))
            }
            How::Singular { order } => format!(
                "to {} a motion passes through this singular pose, and none with more freedoms does",
                in_words(order)
            ),
            How::Traced { poses, regular } => format!(
                "followed numerically through {poses} poses; {}",
                if regular {
                    "the pose is regular"
                } else {
                    "the drawn pose is singular or shaky"
                }
            ),
            How::Undecided | How::Rounded | How::Bound => {
                let (from, to) = (self.mobility, self.most);
                let why = match self.how {
                    How::Bound => {
                        ", the instantaneous mobility; too large for numerical continuation"
                    }
                    How::Rounded => {
                        "; coordinates are rounded too coarsely to distinguish a motion from a shaky pose"
                    }
                    _ => "; neither a proof nor the numerical continuation decides",
                };
                format!("undecided: between {from} and {to}{why}")
            }
        };
        match self.how {
            How::Rigid if self.numeric => format!("{line}, by the numeric rank"),
            _ if self.numeric => format!("by the numeric rank: {line}"),
            How::Submersion { .. } | How::Stopped { .. } | How::Singular { .. } => {
                format!("proven: {line}")
            }
            _ => line,
        }
    }

    /// Returns one word for programs.
    #[must_use]
    pub fn as_word(&self) -> &'static str {
        match self.how {
            How::Rigid if self.mobility > 0 => "free",
            How::Rigid => "rigid",
            How::Submersion { by, .. } => match by {
                Proof::Groups | Proof::Resting => "submersion",
                Proof::Bonds => "bonds",
                Proof::Multiplicity => "multiplicity",
                Proof::Contours => "contours",
            },
            How::Singular { .. } => "singular",
            How::Stopped { order: 2, .. } => "second-order",
            How::Stopped { .. } => "higher-order",
            How::Traced { .. } => "traced",
            How::Undecided | How::Rounded => "undecided",
            How::Bound => "bound",
        }
    }

    /// Adds the finite mobility of an independent part, or of the idle freedoms of a part.
    pub(super) fn combine_with(self, other: Finite) -> Finite {
        use How::{Singular, Stopped, Submersion, Traced};
        // The one that leaves more open decides.
        let (clear, open) = (self.how.min(other.how), self.how.max(other.how));
        let how = match (clear, open) {
            (
                Submersion {
                    dimension: more, ..
                },
                Submersion { dimension, by },
            ) => Submersion {
                dimension: dimension + more,
                by,
            },
            (Stopped { motions: more, .. }, Stopped { order, motions }) => Stopped {
                order,
                motions: motions + more,
            },
            (
                Traced {
                    poses: more,
                    regular: too,
                },
                Traced { poses, regular },
            ) => Traced {
                poses: poses + more,
                regular: regular && too,
            },
            (Stopped { .. } | Singular { .. }, Traced { poses, .. }) => Traced {
                poses,
                regular: false,
            },
            (_, how) => how,
        };
        Finite {
            mobility: self.mobility + other.mobility,
            most: self.most + other.most,
            how,
            numeric: self.numeric || other.numeric,
        }
    }
}

/// Returns what ranks alone prove: that nothing moves, or that all instantaneous motions are finite.
pub(super) fn by_ranks(at: &ExactState<'_>) -> Result<Option<Finite>, ExactError> {
    if at.mobility() == 0 {
        return Ok(Some(Finite::new(0, How::Rigid)));
    }
    let regular = Finite::regular_pose(at.mobility(), at.rank, Proof::Groups);
    Ok((at.rank == group_dimensions(at)?).then_some(regular))
}

/// Returns the dimension of the groups that all contours move in, and of the couplings.
pub(super) fn group_dimensions(at: &ExactState<'_>) -> Result<usize, ExactError> {
    // Couplings are linear in the joints' coordinates, so dependent ones stay dependent all along the motion.
    let couplings = at.closure.couplings.iter().map(|coupling| {
        let mut row = vec![0; at.closure.columns.len()];
        coupling.entries.iter().for_each(|&(c, x)| row[c] = x);
        row
    });
    let mut dimension = Echelon::from_vectors(at.exact.field(), couplings).rank();
    for contour in &at.closure.contours {
        dimension += group_dimension(at.exact, at.mechanism, contour)?;
    }
    Ok(dimension)
}

/// Works as [`by_ranks`], also with the freedoms locked that are at rest to first order, and with chains and legs
/// reduced to single joints.
pub(super) fn prove_regular(at: &ExactState<'_>) -> Result<Option<Finite>, ExactError> {
    if let Some(known) = by_ranks(at)? {
        return Ok(Some(known));
    }
    let instantaneous = at.mobility();
    let moving = match lock_resting(at) {
        Some(locked) => {
            let own = ExactState::new(at.exact, &locked, at.closure.state)?;
            if let Some(found) = by_ranks(&own)?
                && let How::Submersion { dimension, .. } = found.how
                && found.mobility == instantaneous
            {
                return Ok(Some(Finite::regular_pose(
                    instantaneous,
                    dimension,
                    Proof::Resting,
                )));
            }
            bonds::mobility_by_bonds(at.exact, &locked, &own.closure)?
        }
        None => bonds::mobility_by_bonds(at.exact, at.mechanism, &at.closure)?,
    };
    // The motion with freedoms locked is a lower bound, and the instantaneous motion an upper one.
    let moving = moving.filter(|&m| m == instantaneous);
    Ok(moving.map(|m| Finite::regular_pose(m, at.rank, Proof::Bonds)))
}

/// Returns the mechanism with every freedom locked that rests in all instantaneous motions, or `None` if none does.
///
/// # Complexity
/// One elimination of J by rows, O((6k)² f).
fn lock_resting(at: &ExactState<'_>) -> Option<Mechanism> {
    let (exact, mechanism, closure) = (at.exact, at.mechanism, &at.closure);
    let rows = Echelon::from_vectors(exact.field(), transpose(&closure.dense_columns(exact)));
    // A row of the reduced form with no entry other than its pivot means that this freedom has speed 0.
    let alone = |row: &Vec<Residue>| row.iter().positions(|&x| x != 0).exactly_one().ok();
    let coupled = |c: &usize| {
        let joint = closure.columns[*c].joint;
        mechanism.couplings_of(joint).next().is_some()
    };
    let rows = rows.reduced_rows();
    let resting = rows.iter().filter_map(alone).filter(|c| !coupled(c));
    let resting = resting.map(|c| (closure.columns[c].joint, closure.columns[c].freedom));
    let resting: Vec<(JointId, Freedom)> = resting.collect();
    if resting.is_empty() {
        return None;
    }
    let mut out = mechanism.clone();
    for (j, joint) in mechanism.joint_ids().zip(&mut out.parts_mut().joints) {
        let mut kept = joint.joint_type.freedoms().to_vec();
        kept.retain(|&f| !resting.contains(&(j, f)));
        if kept.len() < joint.joint_type.freedoms().len() {
            joint.joint_type = JointType::Custom(kept);
        }
    }
    Some(out)
}

fn in_words(order: usize) -> String {
    let words = ["second order", "third order"].get(order.wrapping_sub(2));
    words.map_or_else(|| format!("order {order}"), |w| (*w).to_owned())
}
