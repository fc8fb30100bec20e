//! Every method on every mechanism of known mobility.

use super::AnswerVerdict;
pub use super::cases::{Case, built_in_cases, generated_cases};
use super::said::Tally;
use super::study::Study;
use super::timing::{Stopwatch, Timing, quantile};
use crate::format::csv;
use crate::rank::method::registry;
use crate::rank::method::{Answer, MobilityMethod, NoAnswer, Quantity};
use rayon::prelude::*;
use std::hint::black_box;

/// The answer of a method to a case.
#[derive(Debug, Clone)]
pub struct Reply {
    /// The answer, or why there is none.
    pub answer: Result<Answer, NoAnswer>,
    /// The verdict on it.
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
    /// Median time of an answer over the cases it answers.
    pub seconds: f64,
}

impl MethodRecord {
    /// Returns the number of cases with a wrong answer, for the pose too.
    pub fn count_wrong(&self) -> usize {
        self.applies - self.right - self.pose
    }
}

/// Every method on every case.
#[derive(Debug)]
pub struct Survey {
    /// The cases, by name.
    pub cases: Vec<Case>,
    /// The replies of each method of [`registry::ALL`], case by case.
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
            let reply = |(method, answer): (&&MobilityMethod, _)| Reply {
                verdict: AnswerVerdict::judge_answer(&answer, case.truth),
                answer,
                time: watch
                    .time_repeatedly(|| black_box(*method).answer(&case.mechanism, case.state))
                    .1,
            };
            replies.push(registry::ALL.iter().zip(answers).map(reply).collect());
        }
        progress(cases.len(), cases.len());
        Survey { cases, replies }
    }

    /// Returns the replies of the `m`th method with their cases.
    pub fn of_method(&self, m: usize) -> impl Iterator<Item = (&Case, &Reply)> {
        self.cases
            .iter()
            .zip(&self.replies)
            .map(move |(c, r)| (c, &r[m]))
    }

    /// Returns the record of the `m`th method.
    pub fn record_of(&self, m: usize) -> MethodRecord {
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
            seconds: quantile(&times, 0.5),
        }
    }

    /// Returns the share of right answers of each method against its median time, as the study of this name.
    pub fn as_study(&self, name: &'static str) -> Study {
        let mut study = Study::new(name, Vec::new());
        for (m, method) in registry::ALL.iter().enumerate() {
            let record = self.record_of(m);
            if record.applies > 0 {
                let tally = Tally::of_share(record.right, self.cases.len(), record.seconds);
                study.add_tally(method.name(), 1.0, tally);
            }
        }
        study
    }

    /// Returns how often answers were timed.
    pub fn describe_repeats(&self) -> String {
        let repeats = self.replies.iter().flatten().map(|r| r.time.repeats);
        match repeats.max() {
            None | Some(0 | 1) => "Each answer was timed once".to_owned(),
            Some(n) => format!("Answers were timed {n} times, slow ones fewer; the median counts"),
        }
    }

    /// Returns a line for each case and method.
    pub fn to_csv(&self) -> String {
        let heads = "mechanism,state,method,answer,quantity,certainty,expected_instantaneous,expected_finite,verdict,error,reason,\
                     median_seconds,least_seconds,most_seconds,repeats";
        let row = |m: usize, case: &Case, reply: &Reply| {
            let (answer, truth, time) = (reply.answer.as_ref().ok(), case.truth, reply.time);
            let of = |f: &dyn Fn(&Answer) -> String| answer.map(f).unwrap_or_default();
            let reason = reply.answer.as_ref().err();
            [
                case.mechanism.name.clone(),
                case.mechanism.states[case.state].clone(),
                registry::ALL[m].name().to_owned(),
                of(&|a| a.mobility.to_string()),
                of(&|a| quantity_word(a.quantity).to_owned()),
                of(&|a| a.certainty.as_word().to_owned()),
                truth.instantaneous.to_string(),
                truth.finite.to_string(),
                reply.verdict.word().to_owned(),
                of(&|a| (a.mobility - truth.finite).to_string()),
                reason.map(ToString::to_string).unwrap_or_default(),
                format!("{:.3e}", time.median),
                format!("{:.3e}", time.least),
                format!("{:.3e}", time.most),
                time.repeats.to_string(),
            ]
        };
        let cases = self.cases.iter().zip(&self.replies);
        let rows = cases.flat_map(|(case, replies)| {
            let each = replies.iter().enumerate();
            each.map(move |(m, reply)| row(m, case, reply))
        });
        csv::write_table(&heads.split(',').collect::<Vec<_>>(), rows)
    }
}

fn quantity_word(q: Quantity) -> &'static str {
    match q {
        Quantity::Count => "count",
        Quantity::Instantaneous => "instantaneous",
        Quantity::Finite => "finite",
    }
}
