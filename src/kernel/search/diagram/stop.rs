//! Why building a diagram ended.

/// Why building ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The search is complete: counts are exact.
    Exhausted,
    /// The node budget cut layers down to a part of their nodes: counts are lower bounds.
    NodeBudget,
    /// Only the cheapest variants were asked for: counts are lower bounds.
    NotCounted,
    /// The memory limit cut layers down in the same way.
    Memory,
    /// The caller asked to end: layers were cut down, counts are lower bounds.
    Interrupted,
}

impl Stop {
    /// Returns the reason for two parts of one search: an interruption, otherwise the first that is not [`Stop::Exhausted`].
    #[must_use]
    pub fn combine_with(self, other: Stop) -> Stop {
        match (self, other) {
            (Stop::Exhausted, _) | (_, Stop::Interrupted) => other,
            _ => self,
        }
    }

    /// Returns true if a diagram is cut down to its limits.
    pub(in crate::search) fn is_cut(self) -> bool {
        matches!(self, Stop::NodeBudget | Stop::Memory)
    }

    /// Returns the word used in machine-readable output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Stop::Exhausted => "exhausted",
            Stop::NodeBudget => "node-budget",
            Stop::NotCounted => "not-counted",
            Stop::Memory => "memory",
            Stop::Interrupted => "interrupted",
        }
    }
}
