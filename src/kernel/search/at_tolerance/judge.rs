//! One variant judged by its singular values.

use super::in_state::{Answer, InStateSeen};
use crate::geom::exact::ExactError;
use crate::model::mechanism::StateId;
use crate::rank::numeric::Elimination;
use crate::search::answer::keys::Key;
use crate::search::check::brute;
use crate::search::check::brute_float::{Approximate, RankedRows};
use crate::search::check::variant_mechanism;
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::question::Question;
use crate::search::question::rounded_rank::{Digits, RankRange};

/// Whether a variant meets some conditions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Standing {
    /// It does not.
    No,
    /// It does.
    Sure(Key),
    /// It may, and has this key if it does.
    Doubtful(Key),
}

/// The result for a variant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judged {
    /// Whether it has few enough redundant constraints.
    pub(super) determinate: Standing,
    /// Whether it meets every condition.
    pub(super) admissible: Standing,
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
        let all = Approximate::new(question, Elimination::Svd, digits.tolerance)?;
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
        let limit = self.question.conditions.max_redundant;
        let Some(free) = self.all.rank_range(choices, RankedRows::Free, self.digits) else {
            let key = self.standing_of(choices, false, Redundancy::default());
            return Judged {
                determinate: key,
                admissible: key,
            };
        };
        let int = |x: usize| u32::try_from(x).unwrap_or(u32::MAX);
        let [rows, _] = self.all.count_equations();
        let (least, most) = (int(rows - free.most), int(rows - free.least));
        if least > limit {
            return Judged {
                determinate: Standing::No,
                admissible: Standing::No,
            };
        }
        let sure = most <= limit;
        let within = Redundancy {
            internal: least,
            ..Redundancy::default()
        };
        // Of a range the figures are doubtful too.
        let determinate = self.standing_of(choices, sure && least == most, within);
        let doubtful = || Judged {
            determinate,
            admissible: self.standing_of(choices, false, within),
        };
        let mut good = Answer::of(sure && least == most, true);
        if self.question.conditions.keep_output {
            let Some(keeps) = self.keeps_output(choices, free) else {
                return doubtful();
            };
            good = good.combine_with(keeps);
        }
        let wanted = |internal| self.is_wanted(choices, internal);
        let mut which = least..=most.min(limit);
        good = good.combine_with(Answer::of(which.clone().all(wanted), which.any(wanted)));
        let mut found = within;
        let asked = self.question.conditions.state;
        if let Some(asked) = asked.filter(|_| good != Answer::No) {
            let Some(seen) = self.in_state(asked.state, choices, free) else {
                return doubtful();
            };
            good = good.combine_with(seen.meets_conditions(&asked));
            (found.external, found.harmful) = seen.figures();
        }
        Judged {
            determinate,
            admissible: match good {
                Answer::No => Standing::No,
                Answer::Perhaps => self.standing_of(choices, false, found),
                Answer::Yes => self.standing_of(choices, true, found),
            },
        }
    }

    /// Returns the standing of a variant with some redundancy that meets the conditions, certainly or possibly.
    fn standing_of(&self, choices: &[usize], sure: bool, redundancy: Redundancy) -> Standing {
        let key = brute::variant_key(self.question, choices, redundancy);
        if sure {
            Standing::Sure(key)
        } else {
            Standing::Doubtful(key)
        }
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

    /// Returns true if a variant meets the conditions on mobility and changes with `internal` redundant constraints.
    fn is_wanted(&self, choices: &[usize], internal: u32) -> bool {
        let redundancy = Redundancy {
            internal,
            ..Redundancy::default()
        };
        self.question
            .is_wanted(brute::variant_key(self.question, choices, redundancy))
    }

    /// Returns the figures of a variant in the searched state; `None` if the singular values do not converge.
    fn in_state(&self, state: StateId, choices: &[usize], free: RankRange) -> Option<InStateSeen> {
        let [rows, state_rows] = self.all.count_equations();
        let realized = variant_mechanism::realize_variant(self.question, choices);
        let of_state = self
            .all
            .rank_range(choices, RankedRows::State, self.digits)?;
        let surplus = |rank: usize| to_i32(state_rows) - to_i32(rank);
        let external = [
            surplus(of_state.most) - to_i32(rows) + to_i32(free.least),
            surplus(of_state.least) - to_i32(rows) + to_i32(free.most),
        ];
        InStateSeen::of(self.question, &realized, state, external, self.digits)
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
