//! Whether a condition is met, so far as digits tell.

/// Whether a condition is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Answer {
    No,
    Perhaps,
    Yes,
}

impl Answer {
    /// From whether it is for sure, and whether it may be.
    pub(super) fn of(sure: bool, may: bool) -> Answer {
        match (sure, may) {
            (true, _) => Answer::Yes,
            (false, true) => Answer::Perhaps,
            (false, false) => Answer::No,
        }
    }

    pub(super) fn and(self, other: Answer) -> Answer {
        match (self, other) {
            (Answer::No, _) | (_, Answer::No) => Answer::No,
            (Answer::Yes, Answer::Yes) => Answer::Yes,
            _ => Answer::Perhaps,
        }
    }
}
