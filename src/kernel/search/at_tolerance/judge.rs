//! One variant judged by its singular values.

use crate::geom::exact::ExactError;
use crate::search::answer::keys::Key;
use crate::search::check::brute_float::{Approximate, RankedRows};
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::question::Question;
use crate::search::question::rounded_rank::{Digits, RankRange};

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

/// The result for a variant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judged {
    /// Whether it has few enough redundant constraints.
    pub(super) determinate: Answer,
    /// Whether it meets every condition.
    pub(super) admissible: Answer,
    /// Its properties, if it does: of a range of ranks the smallest numbers of redundant constraints.
    pub(super) key: Key,
}

/// Judges the variants of a question.
pub(super) struct Judge<'s> {
    question: &'s Question,
    all: Approximate,
    digits: Digits,
    /// The minimum and maximum dimension of the kept links' motion in the free state of the present mechanism.
    motion: [usize; 2],
}

impl<'s> Judge<'s> {
    pub(super) fn new(question: &'s Question, digits: Digits) -> Result<Judge<'s>, ExactError> {
        let all = Approximate::new(question, &question.mechanism, true)?;
        let nothing = vec![0; question.space.variables.len()];
        let unknown = RankRange::from_values(&[], digits);
        let present = all
            .rank_range(&nothing, RankedRows::Free, digits)
            .unwrap_or(unknown);
        let kept = all.rank_range(&nothing, RankedRows::WithKept, digits);
        let motion = motion_range(present, kept.unwrap_or(unknown));
        Ok(Judge {
            question,
            all,
            digits,
            motion,
        })
    }

    pub(super) fn digits(&self) -> Digits {
        self.digits
    }

    /// Returns the largest possible dimension of the kept links' original motion.
    pub(super) fn motion_dimension(&self) -> usize {
        self.motion[1]
    }

    /// Judges a variant; one whose singular values do not converge may be anything.
    ///
    /// # Complexity
    /// One decomposition where it has too many redundant constraints, two otherwise.
    pub(super) fn judge_variant(&self, choices: &[usize]) -> Judged {
        self.judge_ranks(choices).unwrap_or_else(|| Judged {
            determinate: Answer::Perhaps,
            admissible: Answer::Perhaps,
            key: self.key_with(choices, Redundancy::default()),
        })
    }

    /// Judges a variant; `None` if the singular values do not converge.
    fn judge_ranks(&self, choices: &[usize]) -> Option<Judged> {
        let conditions = &self.question.conditions;
        let free = self
            .all
            .rank_range(choices, RankedRows::Free, self.digits)?;
        let int = |x: usize| u32::try_from(x).unwrap_or(u32::MAX);
        let [rows, ..] = self.all.row_counts();
        let (least, most) = (int(rows - free.most), int(rows - free.least));
        let found = Redundancy {
            internal: least,
            ..Redundancy::default()
        };
        // Of a range the figures are doubtful too.
        let is_possible = least <= conditions.max_redundant;
        let determinate = Answer::of(is_possible && least == most, is_possible);
        let mut admissible = determinate;
        if is_possible {
            if conditions.keep_output {
                admissible = admissible.combine_with(self.keeps_output(choices, free)?);
            }
            let wanted = |internal| {
                let redundancy = Redundancy { internal, ..found };
                self.question.is_wanted(self.key_with(choices, redundancy))
            };
            let mut which = least..=most.min(conditions.max_redundant);
            let wanted = Answer::of(which.clone().all(wanted), which.any(wanted));
            admissible = admissible.combine_with(wanted);
        }
        if conditions.state.is_some() {
            // What a variant is in another state is not judged.
            admissible = admissible.combine_with(Answer::Perhaps);
        }
        Some(Judged {
            determinate,
            admissible,
            key: self.key_with(choices, found),
        })
    }

    fn key_with(&self, choices: &[usize], redundancy: Redundancy) -> Key {
        self.question.steps.variant_key(choices, redundancy)
    }

    /// Returns whether the kept links of a variant move as in the present mechanism; `None` if the singular values do not converge.
    fn keeps_output(&self, choices: &[usize], free: RankRange) -> Option<Answer> {
        let kept = self
            .all
            .rank_range(choices, RankedRows::WithKept, self.digits)?;
        let [from, to] = motion_range(free, kept);
        let [had, at_most] = self.motion;
        Some(Answer::of(
            from == to && had == at_most && from == had,
            from <= at_most && had <= to,
        ))
    }
}

/// Returns the smallest and largest dimension of the kept links' motion. They follow from the rank of the closure equations
/// and the rank of these with that motion.
fn motion_range(free: RankRange, kept: RankRange) -> [usize; 2] {
    [
        kept.least.saturating_sub(free.most),
        kept.most.saturating_sub(free.least),
    ]
}

#[cfg(test)]
mod tests;
