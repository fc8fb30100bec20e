//! The terminal: output, progress, interrupts, colour, memory.

pub(in crate::cli) mod charts;
pub(in crate::cli) mod colour;
pub(in crate::cli) mod did_you_mean;
pub(in crate::cli) mod interrupt;
pub(in crate::cli) mod machine;
pub(in crate::cli) mod memory;
pub(in crate::cli) mod output;
pub(in crate::cli) mod progress;
pub(in crate::cli) mod spinner;
