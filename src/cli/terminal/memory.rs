//! How much memory there is, and sizes of memory as words.

mod group;
mod limits;

pub(in crate::cli) use limits::share_pools;

use crate::cli::terminal::machine;
use crate::score::request::Request;

/// A quarter of the memory that the machine has, or that this process may have of it; what the library takes by default where
/// that is not told. Of addresses that are scarce no more than half of those that are left.
pub(in crate::cli) fn quarter() -> usize {
    let most = limits::least().map_or(Request::default().memory as u64, |all| all / 4);
    let taken = machine::addresses().unwrap_or(0);
    let left = limits::ulimit().map(|all| all.saturating_sub(taken) / 2);
    usize::try_from(left.map_or(most, |left| left.min(most))).unwrap_or(usize::MAX)
}

/// "48 MiB", "3.9 GiB".
pub(in crate::cli) fn words(bytes: u64) -> String {
    #[allow(clippy::cast_precision_loss, reason = "told with two digits or three")]
    let mib = bytes as f64 / f64::from(1 << 20);
    match mib {
        m if m < 1000.0 => format!("{m:.0} MiB"),
        m => format!("{:.1} GiB", m / 1024.0),
    }
}

/// Bytes: a number, or one with k, M, G or T behind it (powers of 1024), and B or iB behind that.
pub(in crate::cli) fn bytes(word: &str) -> Result<usize, String> {
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
