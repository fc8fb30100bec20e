//! How many digits a number has that may have been rounded.

/// Lengths with so many significant digits may have been rounded.
pub const LONG_LENGTH: usize = 4;
/// Components of directions with so many may.
pub const LONG_DIRECTION: usize = 3;
