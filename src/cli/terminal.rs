//! The terminal: output, progress, interrupts, colour, memory.

pub(crate) mod interrupt;
pub(crate) mod machine;
pub(crate) mod output;
pub(crate) mod progress;

/// The way a command ended without failing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Done {
    /// It did what was asked.
    Found,
    /// Nothing was found, or something was found that should not exist.
    Nothing,
    /// Some of it failed, which was reported, and the rest was done.
    Partly,
}

impl Done {
    /// Returns `Found` or `Nothing`.
    pub(crate) fn found_or_nothing(found: bool) -> Done {
        if found { Done::Found } else { Done::Nothing }
    }
}
