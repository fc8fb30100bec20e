//! Every method on every built-in mechanism.

use super::{Truth, Verdict};
use crate::builtin;
use crate::file::problem::ImportError;
use crate::file::text::mechanism_from_str;
use crate::format::csv;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, Quantity};
use crate::rank::registry;
use rayon::prelude::*;
use serde::Serialize;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// A slow answer is not timed again once its timing has taken so long.
const PATIENCE: Duration = Duration::from_millis(200);

/// A state of a mechanism with its true figures.
#[derive(Debug, Clone)]
pub struct Case {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The state.
    pub state: StateId,
    /// The figures that the catalogue states.
    pub truth: Truth,
}

impl Case {
    /// The mechanism's name, with the state's where it is not the free one.
    #[must_use]
    pub fn name(&self) -> String {
        match self.state {
            StateId::FREE => self.mechanism.name.clone(),
            s => format!("{}, {}", self.mechanism.name, self.mechanism.states[s]),
        }
    }
}

/// Every state of a built-in mechanism whose mobilities the catalogue states, by name.
///
/// # Errors
/// Where a built-in file is not valid.
pub fn cases() -> Result<Vec<Case>, ImportError> {
    let mut cases = Vec::new();
    for name in builtin::names() {
        let text = builtin::text(name).unwrap_or_default();
        let mechanism = mechanism_from_str(&format!("{name}.toml"), text)?;
        for (state, named) in mechanism.states_with_ids() {
            let stated = mechanism.expected.iter().find(|e| e.state == *named);
            let Some((Some(instantaneous), Some(finite))) =
                stated.map(|e| (e.mobility, e.finite_mobility))
            else {
                continue;
            };
            cases.push(Case {
                mechanism: mechanism.clone(),
                state,
                truth: Truth {
                    instantaneous,
                    finite,
                },
            });
        }
    }
    Ok(cases)
}

/// What a method said of a case.
#[derive(Debug, Clone)]
pub struct Reply {
    /// The answer, or why there is none.
    pub answer: Result<Answer, NoAnswer>,
    /// What it is worth.
    pub verdict: Verdict,
    /// Median time from the parsed mechanism to the answer.
    pub seconds: f64,
}

/// A method's record over all cases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// Cases it answers.
    pub applies: usize,
    /// Cases in which it gives the finite mobility.
    pub right: usize,
    /// Cases in which it gives the mobility at the pose, which is not the finite one.
    pub pose: usize,
    /// `right` of all cases, answered or not.
    pub share: f64,
    /// Median time of an answer over the cases it answers.
    pub seconds: f64,
}

/// Every method on every case.
#[derive(Debug)]
pub struct Survey {
    /// The cases, by name.
    pub cases: Vec<Case>,
    /// What each method of [`registry::ALL`] said, case by case.
    pub replies: Vec<Vec<Reply>>,
}

/// The middle of some numbers; the mean of the middle two where their number is even, 0 of none.
#[must_use]
pub fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    match of.len() {
        0 => 0.0,
        n if n % 2 == 1 => of[n / 2],
        n => f64::midpoint(of[n / 2 - 1], of[n / 2]),
    }
}

/// Median time of up to `repeat` answers, at least one.
pub fn time(method: &dyn MobilityMethod, m: &Mechanism, state: StateId, repeat: usize) -> f64 {
    let begun = Instant::now();
    let mut times = Vec::new();
    while times.len() < repeat.max(1) && (times.is_empty() || begun.elapsed() < PATIENCE) {
        let start = Instant::now();
        let _ = black_box(method.answer(black_box(m), state));
        times.push(start.elapsed().as_secs_f64());
    }
    median(times)
}

impl Survey {
    /// Asks every method about every case: all answers first, on all threads; then times one after another.
    ///
    /// `progress` gets the cases done and their number.
    ///
    /// # Errors
    /// Where a built-in file is not valid.
    pub fn new(
        repeat: usize,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Result<Survey, ImportError> {
        let cases = cases()?;
        let answers: Vec<Vec<Result<Answer, NoAnswer>>> = cases
            .par_iter()
            .map(|c| {
                registry::ALL
                    .iter()
                    .map(|m| m.answer(&c.mechanism, c.state))
                    .collect()
            })
            .collect();
        let mut replies = Vec::with_capacity(cases.len());
        for (n, (case, answers)) in cases.iter().zip(answers).enumerate() {
            progress(n, cases.len());
            let reply = |(method, answer): (&&dyn MobilityMethod, _)| Reply {
                verdict: Verdict::on(&answer, case.truth),
                answer,
                seconds: time(*method, &case.mechanism, case.state, repeat),
            };
            replies.push(registry::ALL.iter().zip(answers).map(reply).collect());
        }
        progress(cases.len(), cases.len());
        Ok(Survey { cases, replies })
    }

    /// The replies of the `m`th method with their cases.
    pub fn of_method(&self, m: usize) -> impl Iterator<Item = (&Case, &Reply)> {
        self.cases
            .iter()
            .zip(&self.replies)
            .map(move |(c, r)| (c, &r[m]))
    }

    /// The record of the `m`th method.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    pub fn standing(&self, m: usize) -> Standing {
        let count = |of: &dyn Fn(&Reply) -> bool| self.of_method(m).filter(|(_, r)| of(r)).count();
        let right = count(&|r| r.verdict == Verdict::Right);
        Standing {
            applies: count(&|r| r.verdict != Verdict::Silent),
            right,
            pose: count(&|r| matches!(r.verdict, Verdict::Pose(_))),
            share: right as f64 / self.cases.len().max(1) as f64,
            seconds: median(
                self.of_method(m)
                    .filter(|(_, r)| r.verdict != Verdict::Silent)
                    .map(|(_, r)| r.seconds)
                    .collect(),
            ),
        }
    }

    /// One line for each case and method.
    pub(crate) fn csv(&self) -> String {
        let of_case = |(case, replies): (&Case, &Vec<Reply>)| {
            let row = |(method, reply): (&&dyn MobilityMethod, &Reply)| {
                let answer = reply.answer.as_ref().ok();
                ReplyRow {
                    mechanism: case.mechanism.name.clone(),
                    state: case.mechanism.states[case.state].clone(),
                    method: method.name(),
                    answer: answer.map(|a| a.mobility),
                    quantity: answer.map(|a| quantity(a.quantity)),
                    certainty: answer.map(|a| certainty(&a.certainty)),
                    expected_instantaneous: case.truth.instantaneous,
                    expected_finite: case.truth.finite,
                    verdict: reply.verdict.word(),
                    error: answer.map(|a| a.mobility - case.truth.finite),
                    reason: reply.answer.as_ref().err().map(ToString::to_string),
                    median_seconds: format!("{:.3e}", reply.seconds),
                }
            };
            registry::ALL
                .iter()
                .zip(replies)
                .map(row)
                .collect::<Vec<_>>()
        };
        csv::records(self.cases.iter().zip(&self.replies).flat_map(of_case))
    }

    /// One line for each method.
    pub(crate) fn methods_csv(&self) -> String {
        csv::records(registry::ALL.iter().enumerate().map(|(n, method)| {
            let s = self.standing(n);
            #[allow(clippy::cast_precision_loss, reason = "counts are small")]
            let answered = s.right as f64 / s.applies.max(1) as f64;
            MethodRow {
                method: method.name(),
                title: method.about().title,
                guarantee: method.about().guarantee,
                complexity: method.about().complexity,
                source: method.about().source,
                cases: self.cases.len(),
                applies_to: s.applies,
                right: s.right,
                right_at_the_pose_only: s.pose,
                share_of_all: format!("{:.4}", s.share),
                share_of_answered: format!("{answered:.4}"),
                median_seconds: format!("{:.3e}", s.seconds),
            }
        }))
    }
}

/// A line of the survey: what one method said of one case.
#[derive(Serialize)]
struct ReplyRow {
    mechanism: String,
    state: String,
    method: &'static str,
    answer: Option<i64>,
    quantity: Option<&'static str>,
    certainty: Option<String>,
    expected_instantaneous: i64,
    expected_finite: i64,
    verdict: &'static str,
    error: Option<i64>,
    reason: Option<String>,
    median_seconds: String,
}

/// A line of the table of methods.
#[derive(Serialize)]
struct MethodRow {
    method: &'static str,
    title: &'static str,
    guarantee: &'static str,
    complexity: &'static str,
    source: &'static str,
    cases: usize,
    applies_to: usize,
    right: usize,
    right_at_the_pose_only: usize,
    share_of_all: String,
    share_of_answered: String,
    median_seconds: String,
}

fn quantity(q: Quantity) -> &'static str {
    match q {
        Quantity::Count => "count",
        Quantity::Instantaneous => "instantaneous",
        Quantity::Finite => "finite",
    }
}

fn certainty(c: &Certainty) -> String {
    match c {
        Certainty::Numeric {
            tolerance,
            kept,
            dropped,
            ..
        } => format!(
            "numeric at {tolerance:.0e}: smallest kept {kept:.1e}, largest dropped {dropped:.1e}"
        ),
        other => other.word().to_owned(),
    }
}
