//! The terminal: output, progress, interrupts, colour, memory.

pub(super) mod charts;
pub(super) mod colour;
pub(super) mod interrupt;
pub(super) mod machine;
pub(super) mod memory;
pub(super) mod output;
pub(super) mod progress;
pub(super) mod spinner;

/// The way a command ended without failing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Done {
    /// It did what was asked.
    Found,
    /// Nothing was found, or something was found that should not exist.
    Nothing,
    /// Some of it failed, which was reported, and the rest was done.
    Partly,
}
