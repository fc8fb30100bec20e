//! Whether constraints that are redundant at the pose of the file are so over the motion: proven, followed, observed in
//! further poses, or unknown.

use crate::format::count_noun;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::motion::pose::Pose;
use crate::rank::finite::local_dimension::null_space_of;
use crate::rank::finite::{Finite, How};
use ozols_dense::{Matrix, add_scaled, difference, norm, svd};

/// Number of further poses examined if nothing else decides what holds over the motion: normally, and if each takes
/// long.
const POSES: [usize; 2] = [20, 5];
/// Work of singular values, rows · columns · the smaller of them, above which a pose takes long.
const LONG: usize = 5_000_000;
/// Number of attempts per required pose. Some poses do not close, and some are outside the limits.
const TRIES: usize = 3;

/// Largest coordinate of a step: radians, and fractions of the mechanism's size.
const STEP: f64 = 0.2;
/// Shares of the step that are tried one after the other.
const SHORTER: [f64; 3] = [1.0, 0.2, 0.04];
/// Number of times that a step that does not close is halved.
const HALVINGS: u32 = 5;
/// Shares of a step at which poses must also close if it follows a motion.
const BETWEEN: [f64; 4] = [0.75, 0.5, 0.25, 0.125];
/// Factor on the root of a gap that bounds the change of singular values.
const SLOPE: f64 = 4.0;
/// Share of the largest singular value above which values are nonzero for any coordinate accuracy.
const COARSEST: f64 = 1e-2;

/// Poses in which the constraints that are redundant at this pose are redundant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Where {
    /// In all poses near this one: it is a regular pose, proven.
    Proven,
    /// In all poses near this one: the motion was followed numerically, and the pose is a regular one.
    Followed,
    /// In `poses` further poses, by singular values.
    Seen {
        /// Number of poses.
        poses: usize,
        /// Whether they are inside the limits of the joints. If this pose is not, they need not be.
        limited: bool,
    },
    /// No loop moves, so there are no other poses nearby.
    Rigid,
    /// At this pose only; in further poses fewer are redundant.
    Pose {
        /// The smallest number in a further pose.
        elsewhere: usize,
        /// Number of poses examined.
        poses: usize,
        /// Whether they are inside the limits of the joints. If this pose is not, they need not be.
        limited: bool,
    },
    /// At this pose, which is shaky and has no others nearby.
    Shaky,
    /// At this pose; nothing else is known.
    Unknown,
}

impl Where {
    /// Returns one word for programs.
    #[must_use]
    pub fn as_word(self) -> &'static str {
        match self {
            Where::Proven => "proven",
            Where::Followed => "followed",
            Where::Seen { .. } => "seen",
            Where::Rigid => "rigid",
            Where::Pose { .. } | Where::Shaky => "pose",
            Where::Unknown => "unknown",
        }
    }

    /// Describes the poses as part of a sentence.
    #[must_use]
    pub fn describe(self) -> String {
        match self {
            Where::Proven => "throughout the motion, not only in this pose (proven)".to_owned(),
            Where::Followed => {
                "throughout the motion, not only in this pose (followed numerically)".to_owned()
            }
            Where::Seen { poses, limited } => format!(
                "at this pose and in {}{} (numeric); not proven for the rest of the motion",
                count_noun(poses, "further closed pose"),
                limit_words(limited)
            ),
            Where::Rigid => "at this pose; no loop moves".to_owned(),
            Where::Shaky => {
                "at this pose only: it is shaky, so more seems to move than does".to_owned()
            }
            Where::Pose {
                elsewhere,
                poses,
                limited,
            } => format!(
                "at this pose; elsewhere in the motion {elsewhere}, by {}{} (numeric)",
                count_noun(poses, "closed pose"),
                limit_words(limited)
            ),
            Where::Unknown => "at this pose; not determined for the rest of the motion".to_owned(),
        }
    }
}

/// Returns the words for poses that are inside the limits of the joints.
fn limit_words(limited: bool) -> &'static str {
    if limited { " inside the limits" } else { "" }
}

/// Returns where the σ of a state holds, and the pose with the fewest redundant constraints if there are fewer than
/// here.
///
/// A pose with as many instantaneous motions as finite ones is regular, so J keeps its rank near it, and the finite
/// mobility decides. Otherwise further closed poses decide. They must be `inside` the limits of the joints if this one
/// is. `redundant` is the upper bound of σ here. Singular values below `tolerance` of the largest count as zero.
/// Coordinates have the relative error `accuracy`, 0 if they are exact.
///
/// If there are fewer finite motions, they do not determine σ over the motion: `W + rows - freedoms` with the finite W
/// is only a lower bound. A beam on two balls has 1 redundant constraint in every pose, and that sum is 0.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// A few closures of O((6k)² f). A decomposition of J per pose, if the finite mobility does not decide.
pub(crate) fn redundant_where(
    m: &Mechanism,
    state: StateId,
    finite: &Finite,
    redundant: usize,
    [tolerance, accuracy]: [f64; 2],
    inside: &dyn Fn(&Pose) -> bool,
) -> Result<(Where, Option<Pose>), ExactError> {
    let pose = Pose::of_file(m, state)?;
    let rows = pose.constraint_rows(match m.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    });
    let instantaneous = (pose.columns.len() + redundant).saturating_sub(rows);
    if let Some(known) = by_mobility(&pose, finite, instantaneous) {
        return Ok((known, None));
    }
    let limited = inside(&pose);
    let walk = Walk {
        pose: &pose,
        rows,
        least_mobility: finite.mobility,
        tolerance,
        accuracy,
        inside: &|p| !limited || inside(p),
    };
    Ok(match walk.examine_poses(redundant) {
        Seen { poses: 0, .. } => (Where::Unknown, None),
        Seen {
            poses,
            least: Some((elsewhere, pose)),
            ..
        } => (
            Where::Pose {
                elsewhere,
                poses,
                limited,
            },
            Some(pose),
        ),
        Seen { unclear: true, .. } => (Where::Unknown, None),
        Seen { poses, .. } => (Where::Seen { poses, limited }, None),
    })
}

/// Returns the result that the finite mobility alone gives for a pose with `instantaneous` motions.
fn by_mobility(pose: &Pose, finite: &Finite, instantaneous: usize) -> Option<Where> {
    if finite.is_undecided() || (finite.numeric && !matches!(finite.how, How::Traced { .. })) {
        return None;
    }
    // Joints in no loop move freely, independent of the loops.
    let loops_rest = finite.mobility + pose.looped_columns() == pose.columns.len();
    let regular = finite.mobility == instantaneous;
    match (regular, loops_rest) {
        (true, true) => Some(Where::Rigid),
        (true, false) if finite.is_proven() => Some(Where::Proven),
        (true, false) => Some(Where::Followed),
        (false, true) => Some(Where::Shaky),
        (false, false) => None,
    }
}

/// Findings in further poses.
#[derive(Default)]
struct Seen {
    poses: usize,
    /// The smallest certain number of redundant constraints, if smaller than here, and the pose.
    least: Option<(usize, Pose)>,
    /// Whether some pose may have fewer, because small singular values leave it open.
    unclear: bool,
}

/// An examination of closed poses near one.
struct Walk<'a> {
    pose: &'a Pose,
    rows: usize,
    /// Lower bound of the number of motions in every pose.
    least_mobility: usize,
    tolerance: f64,
    accuracy: f64,
    inside: &'a dyn Fn(&Pose) -> bool,
}

impl Walk<'_> {
    /// Returns the findings in poses on the motion, if `redundant` constraints are redundant in the pose of the file.
    fn examine_poses(&self, redundant: usize) -> Seen {
        let f = self.pose.columns.len();
        let wanted = POSES[usize::from(self.rows * f * self.rows.min(f) > LONG)];
        let mut out = Seen::default();
        // All coordinates are relative to the pose of the file, so that closure errors do not accumulate. This is the
        // path to the last pose, with its directions of motion.
        let start = (vec![0.0; f], null_space_of(self.pose));
        let mut way = vec![start];
        for i in 0..TRIES * wanted {
            if out.poses == wanted {
                break;
            }
            // Continues from the last pose, and periodically from here, so that several branches of a motion are found.
            if i % 4 == 0 {
                way.truncate(1);
            }
            let (from, span) = &way[way.len() - 1];
            let Some(q) = self.next(from, span, i) else {
                continue;
            };
            let Some(found) = self.judge_pose(&q) else {
                continue;
            };
            out.poses += 1;
            let fewest = out.least.as_ref().map_or(redundant, |l| l.0);
            way.push((q, found.motions));
            if found.redundant[1] < fewest && self.is_joined(&way) {
                out.least = Some((
                    found.redundant[1],
                    self.pose.moved_to(&way[way.len() - 1].0),
                ));
            } else if found.redundant[0] < redundant {
                out.unclear = true;
            }
        }
        out
    }

    /// Returns the next closed pose from one, on a motion in a direction of some columns that depends on the index of
    /// the attempt.
    fn next(&self, from: &[f64], span: &Matrix, i: usize) -> Option<Vec<f64>> {
        if span.ncols() == 0 {
            return None;
        }
        // Every motion takes part, with other weights for each pose, forwards and backwards.
        let weight = |c: usize| f64::from(u32::try_from((c * 7 + i * 3) % 11).unwrap_or(0)) - 5.3;
        let along = span.combine_columns(&(0..span.ncols()).map(weight).collect::<Vec<_>>());
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        // Shorter steps, in case limits leave little space.
        let mut tried = SHORTER
            .iter()
            .filter_map(|s| (self.pose).closed_beside(from, &along, sign * s * STEP, HALVINGS));
        tried.find(|q| (self.inside)(&self.pose.moved_to(q)))
    }

    /// Returns the figures of J at closed coordinates, or `None` if J leaves fewer motions than there are, because then
    /// the pose is not closed well enough.
    fn judge_pose(&self, q: &[f64]) -> Option<Judged> {
        let gap = norm(&self.pose.closure_gaps(q)).max(f64::EPSILON);
        let svd = svd(&self.pose.jacobian_at(q))?;
        // If J is rank-deficient all along the motion, the error of a closed pose is the root of its gap, and J is off
        // by as much.
        let zero = self.tolerance.max(SLOPE * gap.sqrt());
        let coarse = (SLOPE * self.accuracy.sqrt()).min(COARSEST);
        let [most, least] = [zero, zero.max(coarse)].map(|tolerance| svd.rank(tolerance));
        if q.len() - least < self.least_mobility {
            return None;
        }
        Some(Judged {
            redundant: [most, least].map(|rank| self.rows.saturating_sub(rank)),
            motions: svd.null_space(least),
        })
    }

    /// Returns true if closed poses lie between all those of a path, so that the last is on the motion through the
    /// first.
    fn is_joined(&self, way: &[(Vec<f64>, Matrix)]) -> bool {
        way.windows(2).all(|ends| {
            let [from, to] = [&ends[0].0, &ends[1].0];
            let step = difference(to, from);
            BETWEEN.iter().all(|share| {
                let guess = add_scaled(from, *share, &step);
                self.pose.close_loops(guess.clone(), &[]).is_ok_and(|q| {
                    norm(&difference(&q, &guess)) <= share.min(1.0 - share) * norm(&step)
                })
            })
        })
    }
}

/// The figures of J at a pose.
struct Judged {
    /// The smallest and largest number of redundant constraints there.
    redundant: [usize; 2],
    /// The instantaneous motions, one column each.
    motions: Matrix,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{draw_mechanism, four_bar};

    /// If limits leave only the pose of the file, nothing is known about others. Without limits, a four-bar also has
    /// its three redundant constraints in other poses.
    #[test]
    fn poses_outside_the_limits_do_not_count() {
        let m = draw_mechanism(&four_bar(0, 1, 0.0), &[]);
        let finite = Finite::between(0, 1, How::Undecided).by_numeric_rank();
        let found = |inside: &dyn Fn(&Pose) -> bool| {
            redundant_where(&m, StateId::FREE, &finite, 3, [1e-9, 0.0], inside).unwrap()
        };
        let held = |p: &Pose| p.columns.iter().all(|c| c.moved.abs() < 1e-9);
        assert!(matches!(found(&held), (Where::Unknown, None)));
        assert!(matches!(found(&|_| true), (Where::Seen { .. }, None)));
    }
}
