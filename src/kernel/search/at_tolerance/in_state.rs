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

/// The figures of a variant in a state, each with its minimum and maximum.
#[derive(Debug, Clone, Copy)]
pub(super) struct InStateSeen {
    external: [i32; 2],
    harmful: [u32; 2],
    held: Answer,
}

impl InStateSeen {
    /// Examines a variant as a mechanism. Returns `None` if the arithmetic fails.
    ///
    /// A self-stress is harmless if it does no work in any motion that would relieve harmful ones. So the number of harmful
    /// ones is a difference of ranks of J, with these motions added and without them.
    ///
    /// # Complexity
    /// A decomposition for each face. Another one for each body to be held and each link that may hold it.
    pub(super) fn of(
        question: &Question,
        realized: &Mechanism,
        state: StateId,
        external: [i32; 2],
        digits: Digits,
    ) -> Option<InStateSeen> {
        let own = rank_range(realized, state, digits)?;
        let added: Vec<JointId> = realized.joints_added_in(state).collect();
        let fixed = |j: &JointId| realized.joints[*j].joint_type == JointType::Fixed;
        let faces: Vec<JointId> = added.iter().copied().filter(fixed).collect();
        let with = |freed: &dyn Fn(JointId) -> Option<Vec<Freedom>>| {
            let mut freer = realized.clone();
            for &j in &added {
                if let Some(freedoms) = freed(j) {
                    freer.parts_mut().joints[j].joint_type = JointType::Custom(freedoms);
                }
            }
            rank_range(&freer, state, digits)
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
        let harmful = |least: bool| {
            let of = |r: &RankRange| {
                if least {
                    int(r.least.saturating_sub(own.most))
                } else {
                    int(r.most.saturating_sub(own.least))
                }
            };
            all.iter().map(of).min().unwrap_or(0)
        };
        let mut held = Answer::Yes;
        for grasp in &question.grasps {
            held = held.combine_with(holds(realized, state, grasp, own, digits)?);
        }
        Some(InStateSeen {
            external,
            harmful: [harmful(true), harmful(false)],
            held,
        })
    }

    /// Returns true if it meets the conditions on variants in the state.
    pub(super) fn meets_conditions(&self, asked: &InState) -> Answer {
        let below = |[least, most]: [i64; 2], limit: Option<u32>| {
            let fits = |x: i64| limit.is_none_or(|l| x <= i64::from(l));
            // Of a range the figure itself is doubtful.
            Answer::of(least == most && fits(most), fits(least))
        };
        below(self.external.map(i64::from), asked.max_external)
            .combine_with(below(self.harmful.map(i64::from), asked.max_harmful))
            .combine_with(self.held)
    }

    /// Returns the external and harmful redundant constraints, the smallest numbers possible.
    pub(super) fn figures(&self) -> (i32, u32) {
        (self.external[0], self.harmful[0])
    }
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
