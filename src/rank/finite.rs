//! Finite (full-cycle) mobility: the dimension of the motion that is really there, beside the instantaneous f - rank J.

use super::higher_order::HigherOrder;
use super::trace::Traced;
use super::{modular, parts, subgroup, trace};
use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::pose::Pose;

/// Work of one closing, rows² · columns, up to which a pose is followed at all.
const LARGEST: usize = 30_000_000;
/// Work of all closings together.
const WORK: usize = 5_000_000_000;
/// Relative errors of coordinates above which shaky poses close like motions: Wren's platform did with eight decimals.
const COARSE: f64 = 2e-9;
/// Closings at most.
const CLOSINGS: usize = 1_000;

/// Why a finite mobility is what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum How {
    /// Nothing moves even instantaneously.
    Rigid,
    /// J has the full rank of the groups its contours move in and of its couplings: the motion is a manifold. Proven.
    Submersion {
        /// Σ of the dimensions of those groups, and the rank of the couplings.
        dimension: usize,
    },
    /// Instantaneous motions are stopped by second or higher order: a shaky pose. Proven.
    Stopped {
        /// The order that stops the last of them.
        order: usize,
        /// How many instantaneous motions are none.
        motions: usize,
    },
    /// Followed by Newton's method; numeric.
    Traced {
        /// Poses closed.
        poses: usize,
        /// Whether the pose of the file is a regular one of its motion.
        regular: bool,
    },
    /// Neither proof nor pursuit decides.
    Undecided {
        /// The largest dimension of a motion that was found.
        from: usize,
        /// The largest dimension that is not excluded.
        to: usize,
    },
    /// Coordinates are rounded too coarsely to tell a motion from a shaky pose, or to tell the rank of J.
    Rounded {
        /// The most that it can be.
        to: usize,
    },
    /// Not followed, for it is too large: an upper bound, the instantaneous mobility.
    Bound,
}

/// The finite mobility of a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Finite {
    /// Dimension of the motion; the least it can be where that is undecided.
    pub mobility: usize,
    /// How it is known.
    pub how: How,
    /// Whether the rank of J that it starts from is a numeric one.
    pub numeric: bool,
}

impl Finite {
    fn new(mobility: usize, how: How) -> Finite {
        Finite {
            mobility,
            how,
            numeric: false,
        }
    }

    /// Where rounded coordinates tell no more than that at most `to` moves instantaneously.
    pub(super) fn rounded(to: usize) -> Finite {
        Finite::new(0, How::Rounded { to })
    }

    /// Whether it is a range.
    #[must_use]
    pub fn is_undecided(&self) -> bool {
        matches!(self.how, How::Undecided { .. } | How::Rounded { .. })
    }

    /// The same with a rank that is a numeric one.
    #[must_use]
    pub fn by_numeric_rank(self) -> Finite {
        Finite {
            numeric: true,
            ..self
        }
    }

    /// Whether it follows from exact arithmetic alone.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        !self.numeric
            && matches!(
                self.how,
                How::Rigid | How::Submersion { .. } | How::Stopped { .. }
            )
    }

    /// The most it can be.
    #[must_use]
    pub fn at_most(&self) -> usize {
        match self.how {
            How::Undecided { to, .. } | How::Rounded { to } => to,
            _ => self.mobility,
        }
    }

    /// Whether it can be this much.
    #[must_use]
    pub fn could_be(&self, mobility: i64) -> bool {
        let least = i64::try_from(self.mobility).unwrap_or(i64::MAX);
        let most = i64::try_from(self.at_most()).unwrap_or(i64::MAX);
        (least..=most).contains(&mobility)
    }

    /// The figure for people: a number, or a range where that is undecided.
    #[must_use]
    pub fn figure(&self) -> String {
        match self.how {
            How::Undecided { from, to } => format!("{from} to {to}"),
            How::Rounded { to } => format!("{} to {to}", self.mobility),
            _ => self.mobility.to_string(),
        }
    }

    /// One line for people.
    #[must_use]
    pub fn describe(&self) -> String {
        let line = match self.how {
            How::Rigid if self.mobility > 0 => {
                "joints in no contour and idle spins move as they like, nothing else does even instantaneously"
                    .to_owned()
            }
            How::Rigid => "nothing moves even instantaneously".to_owned(),
            How::Submersion { dimension } => format!(
                "J has the full rank {dimension} of the groups its contours move in, so this pose is a regular one"
            ),
            How::Stopped { order, motions } => {
                let what = match motions {
                    1 => "the one instantaneous motion is",
                    _ => "the instantaneous motions left out are",
                };
                let order = match order {
                    2 => "second order".to_owned(),
                    3 => "third order".to_owned(),
                    n => format!("order {n}"),
                };
                format!("{what} stopped by {order} (a shaky pose)")
            }
            How::Traced { poses, regular } => format!(
                "followed numerically through {poses} poses; {}",
                if regular {
                    "the pose is a regular one"
                } else {
                    "the pose of the file is singular or shaky"
                }
            ),
            How::Undecided { from, to } => format!(
                "undecided: between {from} and {to}; the pose of the file is singular, and following branches from it does not decide"
            ),
            How::Rounded { to } => format!(
                "undecided: between {} and {to}; coordinates are rounded too coarsely to tell a motion from a shaky pose",
                self.mobility
            ),
            How::Bound => "an upper bound: too large to be followed".to_owned(),
        };
        match self.how {
            How::Rigid if self.numeric => format!("{line}, by the numeric rank"),
            _ if self.numeric => format!("by the numeric rank: {line}"),
            How::Submersion { .. } | How::Stopped { .. } => format!("proven: {line}"),
            _ => line,
        }
    }

    /// One word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self.how {
            How::Rigid if self.mobility > 0 => "free",
            How::Rigid => "rigid",
            How::Submersion { .. } => "submersion",
            How::Stopped { order: 2, .. } => "second-order",
            How::Stopped { .. } => "higher-order",
            How::Traced { .. } => "traced",
            How::Undecided { .. } | How::Rounded { .. } => "undecided",
            How::Bound => "bound",
        }
    }

    /// The finite mobility of two independent parts, or of a part and its idle freedoms.
    fn and(self, other: Finite) -> Finite {
        use How::{Bound, Rigid, Rounded, Stopped, Submersion, Traced, Undecided};
        let how = match (self.how, other.how) {
            (Rounded { .. }, _) | (_, Rounded { .. }) => Rounded {
                to: self.at_most() + other.at_most(),
            },
            (Undecided { .. }, _) | (_, Undecided { .. }) => Undecided {
                from: self.mobility + other.mobility,
                to: self.at_most() + other.at_most(),
            },
            (Rigid, how) | (how, Rigid) => how,
            (Submersion { dimension: a }, Submersion { dimension: b }) => {
                Submersion { dimension: a + b }
            }
            (Bound, _) | (_, Bound) => Bound,
            (
                Traced { poses, regular },
                Traced {
                    poses: more,
                    regular: too,
                },
            ) => Traced {
                poses: poses + more,
                regular: regular && too,
            },
            (Traced { poses, .. }, Stopped { .. }) | (Stopped { .. }, Traced { poses, .. }) => {
                Traced {
                    poses,
                    regular: false,
                }
            }
            (how @ Traced { .. }, Submersion { .. }) | (Submersion { .. }, how @ Traced { .. }) => {
                how
            }
            (
                Stopped { order, motions },
                Stopped {
                    order: other,
                    motions: more,
                },
            ) => Stopped {
                order: order.max(other),
                motions: motions + more,
            },
            (how @ Stopped { .. }, Submersion { .. })
            | (Submersion { .. }, how @ Stopped { .. }) => how,
        };
        Finite {
            mobility: self.mobility + other.mobility,
            how,
            numeric: self.numeric || other.numeric,
        }
    }
}

/// The finite mobility of a state: proven by groups or by higher order where that works, followed numerically where not;
/// part by part where the mechanism falls into parts.
///
/// # Errors
/// Where a coordinate has no value in the field.
///
/// # Complexity
/// One rank, and where nothing is proven the closings of [`trace::mobility`].
pub fn finite(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
) -> Result<Finite, ExactError> {
    finite_within(exact, mechanism, closure, rank, None)
}

/// [`finite`] for coordinates with a relative error: higher orders are not asked then, since rounding alone would stop a
/// motion, and poses are followed to within the error.
///
/// # Errors
/// As [`finite`].
pub fn finite_within(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
    accuracy: Option<f64>,
) -> Result<Finite, ExactError> {
    if let Some(known) = without_motion(exact, mechanism, closure, rank)? {
        return Ok(known);
    }
    let state = closure.state;
    let parts = parts::parts(closure);
    // Joints in no contour move as they like.
    let inside = |j: JointId| parts.iter().any(|p| p.contains(&j));
    let free = closure.columns.iter().filter(|c| !inside(c.joint)).count();
    let mut total = Finite::new(free, How::Rigid);
    for joints in &parts {
        let mut part = parts::alone(mechanism, joints);
        let mut own = Closure::new(exact, &part, state)?;
        let mut rank = modular::rank(exact, &own);
        if let Some(known) = without_motion(exact, &part, &own, rank)? {
            total = total.and(known);
            continue;
        }
        let idle = parts::lock_idle(exact, &mut part, state)?;
        if idle > 0 {
            total.mobility += idle;
            own = Closure::new(exact, &part, state)?;
            rank = modular::rank(exact, &own);
        }
        let found = match without_motion(exact, &part, &own, rank)? {
            Some(known) => known,
            None => moved(exact, &part, &own, rank, accuracy)?,
        };
        total = total.and(found);
    }
    Ok(total)
}

/// What ranks alone prove: that nothing moves, or that all instantaneous motions are motions.
fn without_motion(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
) -> Result<Option<Finite>, ExactError> {
    let instantaneous = closure.columns.len() - rank;
    if instantaneous == 0 {
        return Ok(Some(Finite::new(0, How::Rigid)));
    }
    // Couplings are linear in the joints' coordinates, so those that depend on others do so all along the motion.
    let mut dimension = subgroup::coupling_rank(exact, closure);
    for contour in &closure.contours {
        dimension += subgroup::group_dimension(exact, mechanism, contour)?;
    }
    Ok((rank == dimension).then_some(Finite::new(instantaneous, How::Submersion { dimension })))
}

/// A part whose motion ranks do not decide: by higher order, and by going there.
fn moved(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
    accuracy: Option<f64>,
) -> Result<Finite, ExactError> {
    let instantaneous = closure.columns.len() - rank;
    let state = closure.state;
    if let Some(accuracy) = accuracy {
        return within(mechanism, state, instantaneous, accuracy);
    }
    let pose = Pose::of_file(mechanism, state)?;
    let series = HigherOrder::new(exact, mechanism, closure, &pose, rank)?;
    let isolated = |m: usize| series.as_ref().and_then(|s| s.isolated(m));
    let stopped = isolated(1);
    let proven = |order| {
        Finite::new(
            0,
            How::Stopped {
                order,
                motions: instantaneous,
            },
        )
    };
    if let (1, Some(order)) = (instantaneous, stopped) {
        return Ok(proven(order));
    }
    // Not everything that moves at first order moves, where series stop it in a random direction.
    let shaky = stopped.is_some();
    let Some(found) = pursued(&pose, instantaneous, shaky) else {
        return Ok(Finite::new(instantaneous - usize::from(shaky), How::Bound));
    };
    if found.regular {
        return Ok(of_pursuit(found));
    }
    Ok(match isolated(instantaneous - found.mobility) {
        Some(order) if found.mobility == 0 => proven(order),
        Some(_) => of_pursuit(Traced {
            at_most: found.mobility,
            ..found
        }),
        None => of_pursuit(found),
    })
}

/// Follows the motion of a pose, where it is not too large for that.
fn pursued(pose: &Pose, instantaneous: usize, shaky: bool) -> Option<Traced> {
    let work = pose.rows() * pose.rows() * pose.columns.len();
    if work > LARGEST {
        return None;
    }
    let budget = (WORK / work.max(1)).clamp(40, CLOSINGS);
    trace::mobility(pose, instantaneous, shaky, budget)
}

/// What following the motion says.
fn of_pursuit(found: Traced) -> Finite {
    let (from, to) = (found.mobility, found.at_most);
    let how = if from < to {
        How::Undecided { from, to }
    } else {
        How::Traced {
            poses: found.poses,
            regular: found.regular,
        }
    };
    Finite::new(from, how)
}

/// The finite mobility by following the motion alone; `instantaneous` where it is too large for that. `accuracy` is the
/// relative error of the coordinates, 0 where they are exact.
///
/// # Errors
/// Where a coordinate has no value.
pub fn followed(
    mechanism: &Mechanism,
    state: StateId,
    instantaneous: usize,
    accuracy: f64,
) -> Result<Finite, ExactError> {
    if instantaneous == 0 {
        return Ok(Finite::new(0, How::Rigid));
    }
    let pose = Pose::of_file(mechanism, state)?.with_accuracy(accuracy);
    let found = pursued(&pose, instantaneous, false);
    Ok(found.map_or(Finite::new(instantaneous, How::Bound), of_pursuit))
}

/// By following the motion, unless coordinates with this relative error would hide what stops it.
///
/// # Errors
/// Where a coordinate has no value.
pub(super) fn within(
    mechanism: &Mechanism,
    state: StateId,
    instantaneous: usize,
    accuracy: f64,
) -> Result<Finite, ExactError> {
    if accuracy > COARSE && instantaneous > 0 {
        return Ok(Finite::rounded(instantaneous));
    }
    followed(mechanism, state, instantaneous, accuracy)
}
