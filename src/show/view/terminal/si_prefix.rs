//! Prefixes of units.

/// Thousands of newtons and the like: the factor to divide by and the prefix, for values up to `greatest`.
pub(crate) fn prefix(greatest: f64) -> (f64, &'static str) {
    match greatest {
        x if x >= 1e7 => (1e6, "M"),
        x if x >= 1e4 => (1e3, "k"),
        _ => (1.0, ""),
    }
}
