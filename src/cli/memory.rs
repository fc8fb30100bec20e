//! How much memory there is, and sizes of memory as words.

use super::machine;
use crate::score::request::Request;
use std::fs::read_to_string;

/// A quarter of the memory that the machine has, or that this process may have of it; what the library takes by default where
/// that is not told.
pub(super) fn quarter() -> usize {
    let machine = machine::memory().and_then(|bytes| usize::try_from(bytes).ok());
    let process = read_to_string("/proc/self/limits").unwrap_or_default();
    let process = after(&process, "Max address space");
    let group = [
        "/sys/fs/cgroup/memory.max",
        "/sys/fs/cgroup/memory/memory.limit_in_bytes",
    ];
    let group = group.iter().filter_map(|f| read_to_string(f).ok());
    let group = group.filter_map(|text| after(&text, "")).min();
    let known = [machine, process, group].into_iter().flatten().min();
    known.map_or(Request::default().memory, |all| all / 4)
}

/// The number that follows a head in a text; none where a word such as "unlimited" does.
fn after(text: &str, head: &str) -> Option<usize> {
    let line = text.lines().find_map(|l| l.strip_prefix(head))?;
    line.split_whitespace().next()?.parse().ok()
}

/// "48 MiB", "3.9 GiB".
pub(super) fn words(bytes: u64) -> String {
    #[allow(clippy::cast_precision_loss, reason = "told with two digits or three")]
    let mib = bytes as f64 / f64::from(1 << 20);
    match mib {
        m if m < 1000.0 => format!("{m:.0} MiB"),
        m => format!("{:.1} GiB", m / 1024.0),
    }
}

/// Bytes: a number, or one with k, M, G or T behind it (powers of 1024), and B or iB behind that.
pub(super) fn bytes(word: &str) -> Result<usize, String> {
    let plain = word.trim_end_matches(['b', 'B']).trim_end_matches('i');
    let units = ["kK", "mM", "gG", "tT"];
    let unit = units
        .iter()
        .position(|u| plain.ends_with(|c| u.contains(c)));
    let (digits, unit) = match unit {
        Some(i) => (&plain[..plain.len() - 1], 1u64 << (10 * (i + 1))),
        None => (plain, 1),
    };
    let number = digits.trim().parse::<f64>().ok();
    #[allow(clippy::cast_precision_loss, reason = "a power of two")]
    let size = number.map(|n| n * unit as f64);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is within the range"
    )]
    let size = size.filter(|s| (1e6..1e15).contains(s)).map(|s| s as usize);
    size.ok_or_else(|| "give a size of 1M or more, such as 500M or 2G".to_owned())
}
