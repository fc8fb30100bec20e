//! Tests whether a variant has the same figures over the stroke as in the file's pose, or only in that one lucky pose.
//!
//! A redesign only adds freedoms, so each variant can take every pose of the original mechanism. Poses are reached by
//! Newton's method from steps along the original motion. Then each joint of a variant is displaced as the original joint is,
//! while its further freedoms rest. The rank there is computed by singular values.
//!
//! A result can hold by luck in two ways. Rank is largest at generic poses, so a variant with σ = 0 has it almost
//! everywhere. But an idle motion that leaves the outputs at rest in the file's pose may move them in others. And the file's
//! pose may be singular, with more instantaneous motions and more redundant constraints than elsewhere.

use crate::closure::tree::path_from_frame;
use crate::geom::exact::ExactError;
use crate::geom::rigid::{RigidMotion, Twist};
use crate::geom::vector::{add, scale, sub};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::finite::local_dimension::null_space_of;
use crate::rank::numeric::scaling::rank_of_values;
use crate::search::answer::k_best::Assignment;
use crate::search::diagram::ShouldCancel;
use crate::search::question::Question;
use crate::search::question::kept::driven_in_variant;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use ozols_dense::{Matrix, least_squares_pivoted, singular_values};
use std::collections::BTreeMap;

/// The largest coordinate of the first steps: radians, and fractions of the mechanism's size.
const STEP: f64 = 0.2;
/// How often a step that does not close is halved.
const HALVINGS: u32 = 4;

/// Maximum number of Newton steps to the coordinates of a joint, and the required accuracy.
const NEWTON: usize = 30;
const REACHED: f64 = 1e-10;

/// The displacement over each joint since the file's pose.
type JointDisplacements = Vec<(JointId, RigidMotion)>;

/// Poses of the present mechanism besides the file's.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Poses asked for.
    pub asked: usize,
    /// The poses reached: the displacements over the original joints in the file's unit, and the dimension of the kept
    /// links' original motion.
    poses: Vec<(JointDisplacements, Option<i64>)>,
}

impl Stroke {
    /// Returns the number of poses reached.
    #[must_use]
    pub fn count_reached(&self) -> usize {
        self.poses.len()
    }
}

/// Figures of a mechanism in a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Figures {
    /// W.
    pub mobility: i64,
    /// σ.
    pub redundant: i64,
    /// Dimension of the kept links' motion, where that is a condition.
    pub output: Option<i64>,
}

/// What other poses say of a variant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OverStroke {
    /// Poses the variant was put into.
    pub poses: usize,
    /// The figures at the first pose where they are not right, and the dimension of the kept links' present motion there.
    pub other: Option<(Figures, Option<i64>)>,
}

impl OverStroke {
    /// Returns true if the variant's figures hold in the file's pose only. `None` if no other pose was reached.
    #[must_use]
    pub fn is_lucky(&self) -> Option<bool> {
        (self.poses > 0).then_some(self.other.is_some())
    }
}

/// Reaches `count` generic poses along the original motion of the free state, in both directions from the file's pose.
/// Returns fewer if it has no motion or if cancelled.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// # Complexity
/// Some closures of O((6k)² f) per pose.
pub fn reach_poses(
    question: &Question,
    count: usize,
    seed: u64,
    cancelled: ShouldCancel<'_>,
) -> Result<Stroke, ExactError> {
    let pose = Pose::of_file(&question.mechanism, StateId::FREE)?;
    let span = null_space_of(&pose);
    let here = vec![0.0; pose.columns.len()];
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut poses = Vec::new();
    for i in 0..if span.ncols() == 0 { 0 } else { count } {
        if cancelled() {
            break;
        }
        let weights: Vec<f64> = (0..span.ncols())
            .map(|_| f64::from(random.next_u32()) / f64::from(u32::MAX) - 0.5)
            .collect();
        let along: Vec<f64> = (0..span.nrows())
            .map(|r| (0..span.ncols()).map(|c| span[(r, c)] * weights[c]).sum())
            .collect();
        // There and back, a little farther each time, at odd places.
        #[allow(clippy::cast_precision_loss, reason = "a small number of poses")]
        let far = STEP * (1.0 + 0.37 * (i / 2) as f64) * if i % 2 == 0 { 1.0 } else { -1.0 };
        if let Some(q) = pose.closed_beside(&here, &along, far, HALVINGS) {
            let mut over = BTreeMap::new();
            for (c, &x) in pose.columns.iter().zip(&q) {
                let at = over.entry(c.joint).or_insert(RigidMotion::IDENTITY);
                *at = at.then(&RigidMotion::exp(&c.twist, x));
            }
            let over = over
                .into_iter()
                .map(|(j, d)| (j, rescale_displacement(&d, &pose, true)));
            let figures = figures_at(question, &question.mechanism, &pose.moved_to(&q));
            poses.push((over.collect(), figures.and_then(|f| f.output)));
        }
    }
    Ok(Stroke {
        asked: count,
        poses,
    })
}

/// Looks at a variant, realized as `m`, in the poses of a stroke.
#[must_use]
pub(crate) fn over_stroke(
    question: &Question,
    stroke: &Stroke,
    variant: &Assignment,
    m: &Mechanism,
) -> OverStroke {
    let mut out = OverStroke {
        poses: 0,
        other: None,
    };
    let Ok(pose) = Pose::of_file(m, StateId::FREE) else {
        return out;
    };
    for (over, output) in &stroke.poses {
        let Some(figures) = figures_of_variant(question, m, &pose, over) else {
            continue;
        };
        out.poses += 1;
        let want = Figures {
            mobility: question.mobility(variant.key),
            redundant: i64::from(variant.key.internal()),
            // Where drives must be independent, the motion is theirs.
            output: match question.mechanism.locked_drives() {
                0 => *output,
                drives => output.and(i64::try_from(drives).ok()),
            },
        };
        if figures != want && out.other.is_none() {
            out.other = Some((figures, *output));
        }
    }
    out
}

/// Returns the figures of a variant in a pose of the original mechanism, given by the displacements of its joints. Freedoms
/// that the original joints do not need rest. `None` if the variant cannot take the pose.
fn figures_of_variant(
    question: &Question,
    m: &Mechanism,
    pose: &Pose,
    at: &[(JointId, RigidMotion)],
) -> Option<Figures> {
    let mut q = vec![0.0; pose.columns.len()];
    for (joint, goal) in at {
        let own: Vec<usize> = (0..pose.columns.len())
            .filter(|&c| pose.columns[c].joint == *joint)
            .collect();
        let twists: Vec<Twist> = own.iter().map(|&c| pose.columns[c].twist).collect();
        let found = solve_coordinates(&twists, &rescale_displacement(goal, pose, false))?;
        own.iter().zip(found).for_each(|(&c, x)| q[c] = x);
    }
    figures_at(question, m, &pose.moved_to(&q))
}

/// Returns a displacement in the file's unit about its origin, given one in the lengths of a pose about its middle, or the other way
/// round.
fn rescale_displacement(of: &RigidMotion, pose: &Pose, to_file: bool) -> RigidMotion {
    // x -> R x + t about the middle m in lengths L: t' = L t + m - R m, and back.
    let arm = sub(pose.middle, of.map_direction(pose.middle));
    let translation = if to_file {
        add(scale(of.translation, pose.length), arm)
    } else {
        scale(sub(of.translation, arm), 1.0 / pose.length)
    };
    RigidMotion { translation, ..*of }
}

/// Returns coordinates of freedoms in series that make a displacement, by Newton steps; `None` where they do not come to it.
fn solve_coordinates(twists: &[Twist], goal: &RigidMotion) -> Option<Vec<f64>> {
    let mut q = vec![0.0; twists.len()];
    for _ in 0..NEWTON {
        let mut at = RigidMotion::IDENTITY;
        for (twist, &x) in twists.iter().zip(&q) {
            at = at.then(&RigidMotion::exp(twist, x));
        }
        let left = at.inverse().then(goal);
        let gap = [left.rotation_vector(), left.translation].concat();
        if gap.iter().all(|x| x.abs() < REACHED) {
            return Some(q);
        }
        if twists.is_empty() {
            return None;
        }
        // A freedom's twist as it is after those behind it.
        let mut behind = RigidMotion::IDENTITY;
        let mut columns = vec![[0.0; 6]; twists.len()];
        for ((column, twist), &x) in columns.iter_mut().zip(twists).zip(&q).rev() {
            *column = behind.inverse().map_twist(twist);
            behind = RigidMotion::exp(twist, x).then(&behind);
        }
        let matrix = Matrix::from_fn(6, columns.len(), |r, c| columns[c][r]);
        let step = least_squares_pivoted(&matrix, &gap);
        q.iter_mut().zip(step).for_each(|(x, s)| *x += s);
    }
    None
}

/// Returns the figures of a mechanism in one of its poses.
fn figures_at(question: &Question, m: &Mechanism, pose: &Pose) -> Option<Figures> {
    let f = pose.columns.len();
    let jacobian = pose.jacobian_at(&vec![0.0; f]);
    let rank = numeric_rank(&jacobian)?;
    let int = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
    let mobility = int(f) - int(rank);
    let redundant = int(pose.constraint_rows(question.space.dim)) - int(rank);
    if !question.conditions.keep_output {
        return Some(Figures {
            mobility,
            redundant,
            output: None,
        });
    }
    let drives: Vec<usize> = driven_in_variant(&question.mechanism, m)?
        .iter()
        .map(|d| {
            let mut columns = pose.columns.iter();
            columns.position(|c| (c.joint, c.freedom) == (d.joint, d.freedom))
        })
        .collect::<Option<_>>()?;
    let paths: Vec<Vec<(JointId, bool)>> = question
        .kept
        .links
        .iter()
        .map(|&l| path_from_frame(m, StateId::FREE, l))
        .collect();
    Some(Figures {
        mobility,
        redundant,
        output: Some(
            int(crate::search::check::other_poses::numeric_rank(
                &pose.jacobian_with(&paths, &drives),
            )?) - int(rank),
        ),
    })
}

/// Returns the rank by singular values.
fn numeric_rank(matrix: &Matrix) -> Option<usize> {
    Some(rank_of_values(singular_values(matrix)?, FLAT).rank)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{Y, Z, draw_mechanism};
    use crate::model::joint_type::JointType;
    use crate::rank::exact::field::exact_field;
    use crate::search::question::conditions::Conditions;

    /// A screw between two hinges that are h apart along it climbs h in a turn: then the hinges lie on one line, and of the four
    /// motions of what turns and slides in its place three are left. What is between says nothing.
    #[test]
    fn what_turns_and_slides_for_a_screw_climbs_with_it() {
        let (high, turn) = (3.0, std::f64::consts::TAU);
        let mut m = draw_mechanism(
            &[
                (JointType::Revolute, [0, 1], [0.0, 0.0, high], Y),
                (JointType::Helical, [1, 2], [0.0; 3], Z),
                (JointType::Revolute, [2, 3], [0.0; 3], Y),
            ],
            &[3],
        );
        m.parts_mut().joints[1].frame.pitch =
            crate::geom::expr::Expr::from_f64(high / turn).unwrap();
        m.parts_mut().joints[1].options[0].frame = m.joints[1].frame.clone();
        let exact = exact_field(&m, 0).unwrap();
        let question = Question::new(exact, m.clone(), Conditions::default()).unwrap();
        m.parts_mut().joints[1].joint_type = JointType::Cylindrical;
        let pose = Pose::of_file(&m, StateId::FREE).unwrap();
        let output = |turns: f64| {
            // The screw climbs along its axis, in the file's unit.
            let climbed = RigidMotion {
                translation: [0.0, 0.0, turns * high],
                ..RigidMotion::from_turn([0.0, 0.0, 1.0], turns * turn)
            };
            let at = [(JointId::new(1), climbed)];
            figures_of_variant(&question, &m, &pose, &at)
                .unwrap()
                .output
        };
        assert_eq!([0.0, 1.0, 2.0].map(output), [Some(4), Some(3), Some(4)]);
    }
}
