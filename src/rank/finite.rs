//! Finite (full-cycle) mobility: the dimension of the motion that is really there, beside the instantaneous f - rank J.

use super::field::field_of;
use super::method::{About, Answer, Certainty, MobilityMethod, NoAnswer, Quantity, RankOfJ};
use super::{second_order, subgroup, trace};
use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::pose::Pose;

/// Work of one closing, rows² · columns, up to which a pose is followed at all.
const LARGEST: usize = 30_000_000;
/// Work of all closings together.
const WORK: usize = 5_000_000_000;

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
    /// The one instantaneous motion is stopped by second order: a shaky pose. Proven.
    Stopped,
    /// Followed by Newton's method; numeric.
    Traced {
        /// Poses closed.
        poses: usize,
        /// Whether the pose of the file is a regular one of its motion.
        regular: bool,
    },
    /// Not followed, for it is too large: an upper bound, the instantaneous mobility.
    Bound,
}

/// The finite mobility of a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Finite {
    /// Dimension of the motion.
    pub mobility: usize,
    /// How it is known.
    pub how: How,
}

impl Finite {
    /// Whether it follows from exact arithmetic alone.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        matches!(self.how, How::Rigid | How::Submersion { .. } | How::Stopped)
    }

    /// One line for people.
    #[must_use]
    pub fn describe(&self) -> String {
        match self.how {
            How::Rigid => "nothing moves even instantaneously".to_owned(),
            How::Submersion { dimension } => format!(
                "proven: J has the full rank {dimension} of the groups its contours move in, so this pose is a regular one"
            ),
            How::Stopped => {
                "proven: the one instantaneous motion is stopped by second order (a shaky pose)"
                    .to_owned()
            }
            How::Traced {
                poses,
                regular: true,
            } => format!("followed numerically through {poses} poses; the pose is a regular one"),
            How::Traced {
                poses,
                regular: false,
            } => format!(
                "followed numerically through {poses} poses; the pose of the file is singular or shaky"
            ),
            How::Bound => "an upper bound: too large to be followed".to_owned(),
        }
    }

    /// One word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self.how {
            How::Rigid => "rigid",
            How::Submersion { .. } => "submersion",
            How::Stopped => "second-order",
            How::Traced { .. } => "traced",
            How::Bound => "bound",
        }
    }
}

/// The finite mobility of a state: proven by groups or by second order where that works, followed numerically where not.
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

/// [`finite`] for coordinates with a relative error: second order is not asked then, since rounding alone would stop a
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
    let instantaneous = closure.columns.len() - rank;
    if instantaneous == 0 {
        return Ok(Finite {
            mobility: 0,
            how: How::Rigid,
        });
    }
    // Couplings are linear in the joints' coordinates, so those that depend on others do so all along the motion.
    let mut dimension = coupling_rank(exact, closure);
    for contour in &closure.contours {
        dimension += subgroup::group_dimension(exact, mechanism, contour)?;
    }
    if rank == dimension {
        return Ok(Finite {
            mobility: instantaneous,
            how: How::Submersion { dimension },
        });
    }
    if instantaneous == 1 && accuracy.is_none() {
        let columns = closure.dense(exact);
        let kernel = echelon::relations(exact.field(), &columns);
        if let [x] = kernel.as_slice()
            && second_order::stops(exact, mechanism, closure, x)?
        {
            return Ok(Finite {
                mobility: 0,
                how: How::Stopped,
            });
        }
    }
    followed(
        mechanism,
        closure.state,
        instantaneous,
        accuracy.unwrap_or(0.0),
    )
}

/// Rank of the rows of the couplings alone.
fn coupling_rank(exact: &ExactField, closure: &Closure<Residue>) -> usize {
    let rows: Vec<Vec<Residue>> = closure
        .couplings
        .iter()
        .map(|coupling| {
            let mut row = vec![0; closure.columns.len()];
            for &(c, x) in &coupling.entries {
                row[c] = x;
            }
            row
        })
        .collect();
    echelon::rank(exact.field(), rows.iter().map(Vec::as_slice))
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
    let pose = Pose::of_file(mechanism, state)?.with_accuracy(accuracy);
    let work = pose.rows() * pose.rows() * pose.columns.len();
    let bound = Finite {
        mobility: instantaneous,
        how: How::Bound,
    };
    if work > LARGEST {
        return Ok(bound);
    }
    let budget = (WORK / work.max(1)).clamp(40, 20_000);
    Ok(trace::mobility(&pose, budget).map_or(bound, |t| Finite {
        mobility: t.mobility.min(instantaneous),
        how: How::Traced {
            poses: t.poses,
            regular: t.regular,
        },
    }))
}

/// Exact rank at the pose, then [`finite`], as a method.
#[derive(Debug, Clone, Copy)]
pub struct Exact;

impl MobilityMethod for Exact {
    fn about(&self) -> &'static About {
        &About {
            name: "finite",
            title: "finite mobility, exact geometry",
            help: "Exact rank, and the mobility that is really there",
            guarantee: "proven where groups or second order decide; else followed numerically",
            complexity: "one modular rank; else some ten to some hundred closings of O((6k)² f)",
            source: "Hervé 1978 (groups); Connelly & Whiteley 1996 (second order); Wampler, Hauenstein & Sommese 2011 (local dimension)",
            rank: RankOfJ::Exact,
        }
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let exact = field_of(mechanism, state, 0)?;
        let closure = Closure::new(&exact, mechanism, state)?;
        let rank = super::modular::rank(&exact, &closure);
        let found = finite(&exact, mechanism, &closure, rank)?;
        Ok(Answer {
            mobility: i64::try_from(found.mobility).unwrap_or(i64::MAX),
            quantity: Quantity::Finite,
            certainty: if found.is_proven() {
                Certainty::Exact
            } else {
                Certainty::Traced
            },
        })
    }
}
