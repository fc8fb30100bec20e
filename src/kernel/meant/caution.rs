//! How far relations may move numbers.

/// A direction that moves its components by this many halves of their last digits is within them: it is fitted, not solved for.
pub(super) const WITHIN: f64 = 1.1;

/// How bold relations are taken.
#[derive(Debug, Clone, Copy)]
pub(super) struct Caution {
    /// Moves may be larger by this.
    pub(super) bold: f64,
    /// Whether relations count that may be there by chance.
    pub(super) weak: bool,
}
