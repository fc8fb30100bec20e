//! Whether what is redundant at the pose of the file is so over the motion: proven, followed, seen in further poses, or
//! not known.

use crate::geom::exact::ExactError;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::motion::pose::Pose;
use crate::rank::finite::{Finite, How};
use crate::rank::scaled::rank_of_values;
use crate::rank::trace::motions;
use ozols_dense::singular_values;

/// Largest coordinate of a step: radians, and fractions of the mechanism's size.
const STEP: f64 = 0.2;
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
        /// The fewest seen in a further pose; none where the pose is proven to be a shaky one without others near.
        elsewhere: Option<usize>,
    },
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
            Where::Pose { .. } => "pose",
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
            Where::Seen { poses } => {
                format!(
                    "at this pose and in {poses} further ones (numeric), not proven over the motion"
                )
            }
            Where::Rigid => "at this pose, and no loop moves".to_owned(),
            Where::Pose { elsewhere: None } => {
                "at this pose only: it is a shaky one, where more seems to move than does"
                    .to_owned()
            }
            Where::Pose { elsewhere: Some(n) } => {
                format!("at this pose; elsewhere on the motion {n} (numeric)")
            }
            Where::Unknown => "at this pose; over the motion it is not known".to_owned(),
        }
    }
}

/// Where the σ of a state holds, by what is known of its finite mobility or else by `poses` further poses. Singular values
/// below `tolerance` of the largest count as zero.
///
/// # Errors
/// Where a coordinate has no value.
///
/// # Complexity
/// Some closings of O((6k)² f) and a decomposition of J a pose, where finite mobility does not tell.
pub fn redundant_where(
    m: &Mechanism,
    state: StateId,
    finite: &Finite,
    (redundant, tolerance): (usize, f64),
    poses: usize,
) -> Result<Where, ExactError> {
    match finite.how {
        How::Rigid if !finite.numeric => return Ok(Where::Rigid),
        How::Submersion { .. } if !finite.numeric => return Ok(Where::Proven),
        How::Traced { regular: true, .. } => return Ok(Where::Followed),
        How::Stopped { .. } if finite.mobility == 0 => {
            return Ok(Where::Pose { elsewhere: None });
        }
        _ => {}
    }
    let pose = Pose::of_file(m, state)?;
    let span = motions(&pose);
    let rows = pose.constraints(match m.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    });
    let mut seen: Vec<usize> = Vec::new();
    for i in 0..if span.ncols() == 0 { 0 } else { poses } {
        // Every motion takes part, each pose with other weights, there and back.
        let weight = |c: usize| f64::from(u32::try_from((c * 7 + i * 3) % 11).unwrap_or(0)) - 5.3;
        let along: Vec<f64> = (0..span.nrows())
            .map(|r| (0..span.ncols()).map(|c| span[(r, c)] * weight(c)).sum())
            .collect();
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        let Some(q) = pose.beside(&along, sign * STEP, HALVINGS) else {
            continue;
        };
        let moved = pose.moved(&q);
        let values = singular_values(&moved.jacobian(&vec![0.0; q.len()])).unwrap_or_default();
        seen.push(rows.saturating_sub(rank_of_values(values, tolerance).rank));
    }
    Ok(match seen.iter().min() {
        None => Where::Unknown,
        Some(&least) if least < redundant => Where::Pose {
            elsewhere: Some(least),
        },
        Some(_) => Where::Seen { poses: seen.len() },
    })
}
