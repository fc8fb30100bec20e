//! Whether what is redundant at the pose of the file is so over the motion: proven, followed, seen in further poses, or
//! not known.

use crate::format::phrase::plural;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::motion::pose::Pose;
use crate::rank::finite::local_dimension::motions;
use crate::rank::finite::{Finite, How};
use crate::rank::numeric::scaling::rank_of_values;
use ozols_dense::singular_values;

/// Further poses looked at where nothing else tells what holds over the motion, and where looking takes long.
const POSES: [usize; 2] = [20, 5];
/// Work of singular values, rows · columns · the lesser of them, from which it does.
const LONG: usize = 5_000_000;
/// How often a pose is tried for each that is wanted: some do not close, some are outside the limits.
const TRIES: usize = 3;

/// Largest coordinate of a step: radians, and fractions of the mechanism's size.
const STEP: f64 = 0.2;
/// Shares of it that are tried one after the other.
const SHORTER: [f64; 3] = [1.0, 0.2, 0.04];
/// How often a step that does not close is halved.
const HALVINGS: u32 = 5;

/// Where the redundant constraints of a pose are redundant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Where {
    /// In all poses near this one: it is a regular pose, proven.
    Proven,
    /// In all poses near this one: the motion was followed numerically, and the pose is a regular one.
    Followed,
    /// In so many further poses, by singular values.
    Seen {
        /// Poses.
        poses: usize,
    },
    /// No loop moves: there are no other poses near.
    Rigid,
    /// At this pose; in further poses fewer are redundant.
    Pose {
        /// The fewest seen in a further pose.
        elsewhere: usize,
        /// Poses looked at.
        poses: usize,
    },
    /// At this pose, which is proven to be a shaky one without others near.
    Shaky,
    /// At this pose; no more is known.
    Unknown,
}

impl Where {
    /// One word for programs.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Where::Proven => "proven",
            Where::Followed => "followed",
            Where::Seen { .. } => "seen",
            Where::Rigid => "rigid",
            Where::Pose { .. } | Where::Shaky => "pose",
            Where::Unknown => "unknown",
        }
    }

    /// In a sentence.
    #[must_use]
    pub fn describe(self) -> String {
        match self {
            Where::Proven => "over the motion through this pose (proven)".to_owned(),
            Where::Followed => {
                "over the motion through this pose (followed numerically)".to_owned()
            }
            Where::Seen { poses } => format!(
                "at this pose and in {} inside the limits (numeric), not proven over the motion",
                plural(poses, "further closed pose")
            ),
            Where::Rigid => "at this pose, and no loop moves".to_owned(),
            Where::Shaky => {
                "at this pose only: it is a shaky one, where more seems to move than does"
                    .to_owned()
            }
            Where::Pose { elsewhere, poses } => format!(
                "at this pose; elsewhere on the motion {elsewhere}, by {} inside the limits (numeric)",
                plural(poses, "closed pose")
            ),
            Where::Unknown => "at this pose; over the motion it is not known".to_owned(),
        }
    }
}

/// Where the σ of a state holds, by what is known of its finite mobility or else by further closed poses that are `inside` the
/// limits of the joints, where this one is; and the pose with the fewest redundant constraints, where those are fewer. Singular
/// values below `tolerance` of the largest count as zero.
///
/// # Errors
/// Where a coordinate has no value.
///
/// # Complexity
/// Some closings of O((6k)² f) and two decompositions of J a pose, where finite mobility does not tell.
pub(crate) fn redundant_where(
    m: &Mechanism,
    state: StateId,
    finite: &Finite,
    redundant: usize,
    tolerance: f64,
    inside: &dyn Fn(&Pose) -> bool,
) -> Result<(Where, Option<Pose>), ExactError> {
    match finite.how {
        How::Rigid if !finite.numeric => return Ok((Where::Rigid, None)),
        How::Submersion { .. } if !finite.numeric => return Ok((Where::Proven, None)),
        How::Traced { regular: true, .. } => return Ok((Where::Followed, None)),
        How::Stopped { .. } if finite.mobility == 0 => return Ok((Where::Shaky, None)),
        _ => {}
    }
    let pose = Pose::of_file(m, state)?;
    let rows = pose.constraints(match m.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    });
    let columns = pose.columns.len();
    let long = rows * columns * rows.min(columns) > LONG;
    let wanted = POSES[usize::from(long)];
    let limited = inside(&pose);
    let (mut seen, mut at, mut least) = (0, pose.clone(), (redundant, None));
    for i in 0..TRIES * wanted {
        if seen == wanted {
            break;
        }
        // On from where the last led, and by turns from here, so that several branches of a motion are met.
        let from = if i % 4 == 0 { &pose } else { &at };
        let span = motions(from);
        if span.ncols() == 0 {
            break;
        }
        // Every motion takes part, each pose with other weights, there and back.
        let weight = |c: usize| f64::from(u32::try_from((c * 7 + i * 3) % 11).unwrap_or(0)) - 5.3;
        let along: Vec<f64> = (0..span.nrows())
            .map(|r| (0..span.ncols()).map(|c| span[(r, c)] * weight(c)).sum())
            .collect();
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        // Where limits leave little room, shorter steps.
        let mut tried = SHORTER.iter().filter_map(|s| {
            let q = from.beside(&along, sign * s * STEP, HALVINGS)?;
            Some(from.moved(&q))
        });
        let Some(moved) = tried.find(|p| !limited || inside(p)) else {
            continue;
        };
        let values = singular_values(&moved.jacobian(&vec![0.0; columns])).unwrap_or_default();
        let here = rows.saturating_sub(rank_of_values(values, tolerance).rank);
        seen += 1;
        if here < least.0 {
            least = (here, Some(moved.clone()));
        }
        at = moved;
    }
    Ok(match (seen, least) {
        (0, _) => (Where::Unknown, None),
        (poses, (elsewhere, Some(pose))) => (Where::Pose { elsewhere, poses }, Some(pose)),
        (poses, (_, None)) => (Where::Seen { poses }, None),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{drawn, four_bar};

    /// Where limits leave no room but the pose of the file, nothing is known of others; without any, a four-bar has its three
    /// redundant constraints elsewhere, too.
    #[test]
    fn poses_outside_the_limits_do_not_count() {
        let m = drawn(&four_bar(0, 1, 0.0), &[]);
        let finite = Finite {
            mobility: 0,
            how: How::Undecided { from: 0, to: 1 },
            numeric: true,
        };
        let found = |inside: &dyn Fn(&Pose) -> bool| {
            redundant_where(&m, StateId::FREE, &finite, 3, 1e-9, inside).unwrap()
        };
        let held = |p: &Pose| p.columns.iter().all(|c| c.moved.abs() < 1e-9);
        assert!(matches!(found(&held), (Where::Unknown, None)));
        assert!(matches!(found(&|_| true), (Where::Seen { .. }, None)));
    }
}
