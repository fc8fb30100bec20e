//! How a command ended.

/// How a command ended without failing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Done {
    /// It did what was asked.
    Found,
    /// There was nothing to be found, or something was that should not be there.
    Nothing,
    /// Some of it failed, which was said, and the rest was done.
    Partly,
}
