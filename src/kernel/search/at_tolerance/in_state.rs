//! A variant in the searched state by singular values: external and harmful redundant constraints, and whether bodies are held.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::numeric::scaling::{Scaling, scaled_matrix};
use crate::search::question::Question;
use crate::search::question::conditions::InState;
use crate::search::question::grasp::Grasp;
use crate::search::question::rounded_rank::{Digits, RankRange};
use ozols_dense::{Matrix, singular_values};

/// Whether a condition is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Answer {
    No,
    Perhaps,
    Yes,
}

impl Answer {
    /// Returns the answer from two facts: it is certain, and it is possible.
    pub(super) fn of(sure: bool, may: bool) -> Answer {
        match (sure, may) {
            (true, _) => Answer::Yes,
            (false, true) => Answer::Perhaps,
            (false, false) => Answer::No,
        }
    }

    pub(super) fn combine_with(self, other: Answer) -> Answer {
        match (self, other) {
            (Answer::No, _) | (_, Answer::No) => Answer::No,
            (Answer::Yes, Answer::Yes) => Answer::Yes,
            _ => Answer::Perhaps,
        }
    }
}

/// All freedoms of a body.
const ALL: [Freedom; 6] = [
    Freedom::Rx,
    Freedom::Ry,
    Freedom::Rz,
    Freedom::Tx,
    Freedom::Ty,
    Freedom::Tz,
];

/// Judges a variant, as a mechanism, by the conditions on a state to which it adds redundant constraints in the range `external`. Also returns
/// the smallest possible number of harmful ones. `None` if the arithmetic fails.
///
/// A self-stress is harmless if it does no work in any motion that would relieve harmful ones. So the number of harmful
/// ones is a difference of ranks of J, with these motions added and without them.
///
/// # Complexity
/// A decomposition for each face. Another one for each body to be held and each link that may hold it.
pub(super) fn judge_in_state(
    question: &Question,
    realized: &Mechanism,
    asked: &InState,
    external: [i32; 2],
    digits: Digits,
) -> Option<(Answer, u32)> {
    let own = rank_range(realized, asked.state, digits)?;
    let added: Vec<JointId> = realized.joints_added_in(asked.state).collect();
    let fixed = |j: &JointId| realized.joints[*j].joint_type == JointType::Fixed;
    let faces: Vec<JointId> = added.iter().copied().filter(fixed).collect();
    let with = |freed: &dyn Fn(JointId) -> Option<Vec<Freedom>>| {
        let mut freer = realized.clone();
        for &j in &added {
            if let Some(freedoms) = freed(j) {
                freer.parts_mut().joints[j].joint_type = JointType::Custom(freedoms);
            }
        }
        rank_range(&freer, asked.state, digits)
    };
    let all = if faces.is_empty() {
        vec![with(&|_| Some(ALL.to_vec()))?]
    } else {
        let judged = |at: JointId| {
            with(&|j| {
                faces.contains(&j).then(|| {
                    if j == at {
                        vec![Freedom::Tz, Freedom::Rx, Freedom::Ry]
                    } else {
                        vec![Freedom::Tz]
                    }
                })
            })
        };
        faces.iter().map(|&f| judged(f)).collect::<Option<_>>()?
    };
    let int = |x: usize| u32::try_from(x).unwrap_or(u32::MAX);
    let least = |r: &RankRange| int(r.least.saturating_sub(own.most));
    let most = |r: &RankRange| int(r.most.saturating_sub(own.least));
    let least = all.iter().map(least).min().unwrap_or(0);
    let harmful = [least, all.iter().map(most).min().unwrap_or(0)];
    let below = |[least, most]: [i64; 2], limit: Option<u32>| {
        let fits = |x: i64| limit.is_none_or(|l| x <= i64::from(l));
        // Of a range the figure itself is doubtful.
        Answer::of(least == most && fits(most), fits(least))
    };
    let mut answer = below(external.map(i64::from), asked.max_external)
        .combine_with(below(harmful.map(i64::from), asked.max_harmful));
    for grasp in &question.grasps {
        answer = answer.combine_with(holds(realized, asked.state, grasp, own, digits)?);
    }
    Some((answer, least))
}

fn rank_range(m: &Mechanism, state: StateId, digits: Digits) -> Option<RankRange> {
    let closure = Closure::new(&Reals, m, state).ok()?;
    let values = singular_values(&scaled_matrix(&closure))?;
    Some(RankRange::from_values(&values, digits))
}

/// Returns whether one of the links that may hold a body moves with it in every motion. Then the rows of their relative
/// motion add nothing to the rank.
fn holds(
    m: &Mechanism,
    state: StateId,
    grasp: &Grasp,
    own: RankRange,
    digits: Digits,
) -> Option<Answer> {
    let closure = Closure::new(&Reals, m, state).ok()?;
    let (scaling, matrix) = (Scaling::of_closure(&closure), scaled_matrix(&closure));
    let rows = matrix.nrows();
    let of_body = closure.link_motion(&Reals, m, grasp.body);
    let mut answer = Answer::No;
    for &jaw in &grasp.jaws {
        let of_jaw = closure.link_motion(&Reals, m, jaw);
        let relative = |(c, (a, b)): (usize, (&Vec<f64>, &Vec<f64>))| {
            let twist: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            scaling.scale_column(c, &twist)
        };
        let relative: Vec<Vec<f64>> = of_body
            .iter()
            .zip(&of_jaw)
            .enumerate()
            .map(relative)
            .collect();
        let with = Matrix::from_fn(rows + closure.dim, relative.len(), |r, c| {
            match r.checked_sub(rows) {
                Some(r) => relative[c][r],
                None => matrix[(r, c)],
            }
        });
        let with = RankRange::from_values(&singular_values(&with)?, digits);
        let sure = own.is_decided() && with.is_decided() && own.most == with.most;
        match Answer::of(sure, with.least <= own.most) {
            Answer::Yes => return Some(Answer::Yes),
            Answer::Perhaps => answer = Answer::Perhaps,
            Answer::No => {}
        }
    }
    Some(answer)
}
