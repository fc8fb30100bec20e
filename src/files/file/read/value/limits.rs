//! How large a file may be.

/// Most links, joints (and as many contours), and options of one joint in a file.
pub(crate) const LIMITS: (usize, usize, usize) = (2000, 4000, 64);

/// Most entries of the closure matrix written out: 256 MB, and an elimination of some minutes.
pub(crate) const ENTRIES: usize = 1 << 25;
