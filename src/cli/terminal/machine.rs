//! The machine: its clocks, the memory that a search may take of it, and its description for measurements.

use crate::accuracy::timing::Machine;
use crate::score::request::Request;
use std::fs::read_to_string;
use std::path::Path;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Returns the time since the first call.
pub(crate) fn elapsed_time() -> Duration {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGUN.elapsed()
}

/// Returns the processor time that the threads of this process have used so far, which is independent of the load of the machine.
#[cfg(unix)]
pub(crate) fn processor_time() -> Duration {
    let told = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Duration::try_from(told).unwrap_or_default()
}

/// Returns the time on the clock, if no other is available.
#[cfg(not(unix))]
pub(crate) fn processor_time() -> Duration {
    elapsed_time()
}

/// Returns the value of a line such as `model name : AMD EPYC` of a file of the system.
fn read_value(file: &str, key: &str) -> Option<String> {
    let text = read_to_string(file).ok()?;
    let line = text.lines().find(|l| l.starts_with(key))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// Returns the memory of the machine, in bytes.
#[cfg(target_os = "linux")]
pub(crate) fn total_memory() -> Option<u64> {
    let told = rustix::system::sysinfo();
    #[allow(
        clippy::useless_conversion,
        reason = "it has fewer bits on other processors"
    )]
    let (total, unit) = (u64::from(told.totalram), u64::from(told.mem_unit));
    total.checked_mul(unit)
}

/// Returns nothing: the memory of the machine is not known here.
#[cfg(not(target_os = "linux"))]
pub(crate) fn total_memory() -> Option<u64> {
    None
}

/// Returns the size of the address space of this process, in bytes.
pub(crate) fn address_space() -> Option<u64> {
    read_kilobytes("/proc/self/status", "VmSize")
}

/// Returns the peak memory of this process, in bytes.
pub(crate) fn peak_memory() -> Option<u64> {
    read_kilobytes("/proc/self/status", "VmHWM")
}

/// Returns a number of kilobytes of a file of the system, in bytes.
fn read_kilobytes(file: &str, key: &str) -> Option<u64> {
    let kilobytes = read_value(file, key)?;
    Some(1024 * kilobytes.split(' ').next()?.parse::<u64>().ok()?)
}

/// Returns this machine, as far as its system describes it.
pub(crate) fn this_machine() -> Machine {
    let architecture = std::env::consts::ARCH;
    let named = ["model name", "Hardware", "cpu model"];
    let processor = named
        .iter()
        .find_map(|key| read_value("/proc/cpuinfo", key))
        .or_else(|| std::env::var("PROCESSOR_IDENTIFIER").ok());
    let threads = rayon::current_num_threads();
    Machine {
        processor: processor.unwrap_or_else(|| format!("{architecture} processor")),
        threads,
        cores: std::thread::available_parallelism().map_or(threads, usize::from),
        memory: total_memory(),
        system: format!("{} {architecture}", std::env::consts::OS),
        version: env!("CARGO_PKG_VERSION"),
        optimised: !cfg!(debug_assertions),
        clock: if cfg!(unix) { "processor time" } else { "time" },
    }
}

/// Returns a quarter of the memory that the machine has, or that this process may have of it; the library's default if that is
/// unknown. If addresses are scarce, returns at most half of those that are left.
pub(crate) fn quarter_of_memory() -> usize {
    let most = least_limit().map_or(Request::default().memory as u64, |all| all / 4);
    let taken = address_space().unwrap_or(0);
    let left = address_limit().map(|all| all.saturating_sub(taken) / 2);
    usize::try_from(left.map_or(most, |left| left.min(most))).unwrap_or(usize::MAX)
}

/// Returns a size in words, such as "48 MiB" or "3.9 GiB".
pub(crate) fn format_bytes(bytes: u64) -> String {
    #[allow(
        clippy::cast_precision_loss,
        reason = "printed with two digits or three"
    )]
    let mib = bytes as f64 / f64::from(1 << 20);
    match mib {
        m if m < 1000.0 => format!("{m:.0} MiB"),
        m => format!("{:.1} GiB", m / 1024.0),
    }
}

/// Parses a size in bytes: a number, optionally followed by k, M, G or T (powers of 1024), and B or iB.
pub(crate) fn parse_bytes(word: &str) -> Result<usize, String> {
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
    size.ok_or_else(|| "give a size of at least 1M, such as 500M or 2G".to_owned())
}

/// Returns the smallest limit on the memory of this process, in bytes, or `None` if none is known.
fn least_limit() -> Option<u64> {
    let known = [total_memory(), group_limit(), address_limit()];
    known.into_iter().flatten().min()
}

/// Returns the limit on addresses or data of the process, in bytes: `ulimit -v` and `ulimit -d`.
#[cfg(unix)]
fn address_limit() -> Option<u64> {
    use rustix::process::{Resource, getrlimit};
    let limits = [Resource::As, Resource::Data].map(|r| getrlimit(r).current);
    limits.into_iter().flatten().min()
}

#[cfg(not(unix))]
fn address_limit() -> Option<u64> {
    None
}

/// Returns the least memory limit of the control groups (version 2) that this process is in, in bytes.
fn group_limit() -> Option<u64> {
    let own = read_to_string("/proc/self/cgroup").ok()?;
    let group = own.lines().find_map(|l| l.strip_prefix("0::/"))?;
    let limit = |group: &Path| {
        let file = Path::new("/sys/fs/cgroup").join(group).join("memory.max");
        // "max" is none.
        read_to_string(file).ok()?.trim().parse().ok()
    };
    Path::new(group).ancestors().filter_map(limit).min()
}
