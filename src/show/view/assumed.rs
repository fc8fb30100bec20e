//! How sure figures are that rest on what a reader took for granted: they are those of the file as read.

use crate::format::plural;
use crate::model::mechanism::Mechanism;

/// Returns the words for how sure a figure is, with the number of assumptions where there are any.
pub(crate) fn as_read(m: &Mechanism, sure: String) -> String {
    match with_assumptions(m) {
        None => sure,
        Some(read) => format!("{read}: {sure}"),
    }
}

/// Returns "of the file as read, with 2 assumptions", or nothing where nothing was assumed.
pub(crate) fn with_assumptions(m: &Mechanism) -> Option<String> {
    let n = m.assumed.len();
    (n > 0).then(|| format!("of the file as read, with {}", plural(n, "assumption")))
}

/// Returns the same in one word for programs: `as-read`, or the word given where nothing was assumed.
pub(crate) fn kind(m: &Mechanism, sure: &'static str) -> &'static str {
    if m.assumed.is_empty() { sure } else { AS_READ }
}

/// What is said of figures that rest on assumptions.
pub(crate) const AS_READ: &str = "as-read";
