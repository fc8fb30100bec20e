//! One variant judged by its singular values.

use super::in_state::{Answer, judge_in_state};
use crate::geom::exact::ExactError;
use crate::search::answer::keys::Key;
use crate::search::check::brute_float::{Approximate, RankedRows};
use crate::search::check::variant_mechanism;
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::question::Question;
use crate::search::question::rounded_rank::{Digits, RankRange};
use std::ops::RangeInclusive;

/// The result for a variant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judged {
    /// Whether it has few enough redundant constraints.
    pub(super) determinate: Answer,
    /// Whether it meets every condition.
    pub(super) admissible: Answer,
    /// Its properties; if ranks are a range, with the fewest redundant constraints that are possible.
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
    /// One decomposition where it has too many redundant constraints, two otherwise; with a state some more.
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
        let mut found = Redundancy {
            internal: least,
            ..Redundancy::default()
        };
        // Of a range the figures are doubtful too.
        let is_possible = least <= conditions.max_redundant;
        let determinate = Answer::of(is_possible && least == most, is_possible);
        let mut admissible = determinate;
        if is_possible {
            let internal = least..=most.min(conditions.max_redundant);
            let judged = self.judge_further(choices, free, internal, &mut found);
            admissible = judged.map_or(Answer::Perhaps, |further| admissible.combine_with(further));
        }
        Some(Judged {
            determinate,
            admissible,
            key: self.key_with(choices, found),
        })
    }

    /// Judges whether a variant with so many redundant constraints meets the further conditions, and completes what it has `found` in the
    /// searched state. Returns `None` if the singular values do not converge.
    fn judge_further(
        &self,
        choices: &[usize],
        free: RankRange,
        mut internal: RangeInclusive<u32>,
        found: &mut Redundancy,
    ) -> Option<Answer> {
        let conditions = &self.question.conditions;
        let wanted = |internal| {
            let redundancy = Redundancy { internal, ..*found };
            self.question.is_wanted(self.key_with(choices, redundancy))
        };
        let mut meets = Answer::of(internal.clone().all(wanted), internal.any(wanted));
        if conditions.keep_output {
            meets = meets.combine_with(self.keeps_output(choices, free)?);
        }
        if let Some(asked) = conditions.state
            && meets != Answer::No
        {
            let realized = variant_mechanism::realize_variant(self.question, choices);
            let external = self.external_range(choices, free)?;
            let (question, digits) = (self.question, self.digits);
            let (holds, harmful) = judge_in_state(question, &realized, &asked, external, digits)?;
            meets = meets.combine_with(holds);
            (found.external, found.harmful) = (external[0], harmful);
        }
        Some(meets)
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

    /// Returns the range of the redundant constraints that the searched state adds; `None` if the singular values do not converge.
    fn external_range(&self, choices: &[usize], free: RankRange) -> Option<[i32; 2]> {
        let [rows, _, state_rows] = self.all.row_counts();
        let of_state = self
            .all
            .rank_range(choices, RankedRows::State, self.digits)?;
        let surplus = |rank: usize| to_i32(state_rows) - to_i32(rank);
        Some([
            surplus(of_state.most) - to_i32(rows) + to_i32(free.least),
            surplus(of_state.least) - to_i32(rows) + to_i32(free.most),
        ])
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

fn to_i32(x: usize) -> i32 {
    i32::try_from(x).unwrap_or(i32::MAX / 4)
}

#[cfg(test)]
mod tests;
