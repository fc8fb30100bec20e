//! Every method on every mechanism of known mobility.

use super::AnswerVerdict;
pub use super::cases::{Case, cases, generated};
use super::timing::{Stopwatch, Timing, quantile};
use crate::format::csv;
use crate::rank::method::registry;
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, Quantity};
use rayon::prelude::*;
use serde::Serialize;
use std::hint::black_box;

/// What a method said of a case.
#[derive(Debug, Clone)]
pub struct Reply {
    /// The answer, or why there is none.
    pub answer: Result<Answer, NoAnswer>,
    /// What it is worth.
    pub verdict: AnswerVerdict,
    /// Time from the parsed mechanism to the answer.
    pub time: Timing,
}

/// A method's record over all cases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MethodRecord {
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
    /// The times between which the answers of the middle half of those cases lie.
    pub middle_half: [f64; 2],
}

impl MethodRecord {
    /// Cases it answers wrongly, for the pose too.
    #[must_use]
    pub fn wrong(&self) -> usize {
        self.applies - self.right - self.pose
    }
}

/// Every method on every case.
#[derive(Debug)]
pub struct Survey {
    /// The cases, by name.
    pub cases: Vec<Case>,
    /// What each method of [`registry::ALL`] said, case by case.
    pub replies: Vec<Vec<Reply>>,
}

impl Survey {
    /// Asks every method about every case: all answers first, on all threads; then times one after another.
    ///
    /// `progress` gets the cases done and their number.
    pub fn new(
        cases: Vec<Case>,
        watch: Stopwatch,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Survey {
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
                verdict: AnswerVerdict::on(&answer, case.truth),
                answer,
                time: watch
                    .time(|| black_box(*method).answer(&case.mechanism, case.state))
                    .1,
            };
            replies.push(registry::ALL.iter().zip(answers).map(reply).collect());
        }
        progress(cases.len(), cases.len());
        Survey { cases, replies }
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
    pub fn standing(&self, m: usize) -> MethodRecord {
        let count = |of: &dyn Fn(&Reply) -> bool| self.of_method(m).filter(|(_, r)| of(r)).count();
        let right = count(&|r| r.verdict == AnswerVerdict::Right);
        let times: Vec<f64> = self
            .of_method(m)
            .filter(|(_, r)| r.verdict != AnswerVerdict::Silent)
            .map(|(_, r)| r.time.median)
            .collect();
        MethodRecord {
            applies: count(&|r| r.verdict != AnswerVerdict::Silent),
            right,
            pose: count(&|r| matches!(r.verdict, AnswerVerdict::Pose(_))),
            share: right as f64 / self.cases.len().max(1) as f64,
            seconds: quantile(&times, 0.5),
            middle_half: [0.25, 0.75].map(|at| quantile(&times, at)),
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
                    median_seconds: seconds(reply.time.median),
                    least_seconds: seconds(reply.time.least),
                    most_seconds: seconds(reply.time.most),
                    repeats: reply.time.repeats,
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
    least_seconds: String,
    most_seconds: String,
    repeats: usize,
}

fn seconds(x: f64) -> String {
    format!("{x:.3e}")
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
