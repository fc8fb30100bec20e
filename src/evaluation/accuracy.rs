//! Accuracy and speed of every rank method on the built-in mechanisms.
//!
//! The [`survey`] asks every method of [`crate::rank::method`] about mechanisms of known mobility; [`stability`] moves
//! geometry, digits, size, unit and prime until answers turn wrong. `benches/ways` compares the ways of searching.
//! Verdicts are the same on every run; only times differ.

pub(crate) mod cases;
pub mod change;
pub mod lattice;
pub mod said;
pub mod special;
pub mod stability;
pub mod study;
pub mod survey;
pub mod timing;

use crate::rank::method::{Answer, NoAnswer, Quantity};

/// The built-in mechanisms, each its name and the text of its file; the front door has them.
pub type BuiltIn<'a> = &'a [(&'a str, &'a str)];

/// The true figures of a state of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Truth {
    /// f - rank J at the pose of the file.
    pub instantaneous: i64,
    /// The motion that is really there.
    pub finite: i64,
}

impl Truth {
    /// Returns the figures with the given mobility at the pose and the given finite mobility.
    pub(crate) const fn new(instantaneous: i64, finite: i64) -> Truth {
        Truth {
            instantaneous,
            finite,
        }
    }
}

/// A verdict on an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnswerVerdict {
    /// The finite mobility.
    Right,
    /// The mobility at the pose, which is all the method speaks of, but not the finite one; by how much.
    Pose(i64),
    /// Wrong by so much.
    Wrong(i64),
    /// The method applies, but its arithmetic failed.
    Failed,
    /// The method does not apply.
    Silent,
}

impl AnswerVerdict {
    /// Returns the verdict on an answer.
    pub fn judge_answer(answer: &Result<Answer, NoAnswer>, truth: Truth) -> AnswerVerdict {
        match answer {
            Ok(a) if a.mobility == truth.finite => AnswerVerdict::Right,
            Ok(a) if a.quantity == Quantity::Instantaneous && a.mobility == truth.instantaneous => {
                AnswerVerdict::Pose(a.mobility - truth.finite)
            }
            Ok(a) => AnswerVerdict::Wrong(a.mobility - truth.finite),
            Err(NoAnswer::Failed(_)) => AnswerVerdict::Failed,
            Err(_) => AnswerVerdict::Silent,
        }
    }

    /// Returns true if the answer is the one that the method promises: the finite mobility, or the instantaneous mobility if
    /// the method computes that.
    pub(crate) fn keeps_promise(answer: &Result<Answer, NoAnswer>, truth: Truth) -> bool {
        answer.as_ref().is_ok_and(|a| match a.quantity {
            Quantity::Instantaneous => a.mobility == truth.instantaneous,
            Quantity::Count | Quantity::Finite => a.mobility == truth.finite,
        })
    }

    /// Returns the word used in machine-readable output.
    pub fn word(self) -> &'static str {
        match self {
            AnswerVerdict::Right => "right",
            AnswerVerdict::Pose(_) => "right at the pose",
            AnswerVerdict::Wrong(_) => "wrong",
            AnswerVerdict::Failed => "failed",
            AnswerVerdict::Silent => "does not apply",
        }
    }
}
